"""Generates the declarations of capi/include/punctura.h for C#, Rust and JavaScript.

python tools/make_c_bindings.py          writes integrations/csharp/Native.cs, rust/src/ffi.rs and wasm/structs.mjs
python tools/make_c_bindings.py --check  fails if these files are out of date

C# and Rust get the functions and structs that their binding (Punctura.cs, lib.rs) names.
"""

import json
import re
import sys
from typing import NamedTuple

from generated import ROOT, write

FOLDER = ROOT / "integrations"
MADE = "// Made by tools/make_c_bindings.py, from punctura.h.\n"

# C has no names for these enumerations; the first word of each is here. A field of that type names it in its comment.
ENUMS = {"OK": "Status", "OUTSIDE": "Phase", "DISARMED": "ServoState", "LIMIT_NONE": "Limit"}
RENAMED = {"healthy": "is_healthy"}  # for C# and Rust, where Healthy() makes a sample

DECLARATION = re.compile(
    r"""\s+|/\*(?P<comment>.*?)\*/|typedef\ int32_t\ punctura_status;|enum\ \{(?P<words>.*?)\};
    |typedef\ struct\ punctura_(?P<handle>\w+)\ punctura_(?P=handle);
    |typedef\ struct\ punctura_(?P<struct>\w+)\ \{(?P<fields>.*?)\}\ punctura_(?P=struct);
    |PUNCTURA_API\ (?P<result>.*?)\ (?P<function>\w+)\((?P<parameters>.*?)\);""",
    re.DOTALL | re.VERBOSE,
)
FIELDS = re.compile(r"([^;]+);\s*(?:/\*(.*?)\*/)?", re.DOTALL)
VARIABLES = re.compile(r"(const )?(?:punctura_)?(\w+)(\**) (\w+(?:\[\d+\])?(?:, \w+(?:\[\d+\])?)*)")


class Variable(NamedTuple):
    """A field or a parameter. `kind`: its type, without const, * and the prefix punctura_."""

    const: bool
    kind: str
    pointers: int
    name: str
    length: int  # of an array, or 0


class Declaration(NamedTuple):
    """Fields that are declared together, and the comment behind them."""

    variables: list[Variable]
    comment: str

    @property
    def enum(self) -> str | None:
        """The enumeration that the comment names: `PUNCTURA_OUTSIDE ...`."""
        first = re.match(r"PUNCTURA_(\w+) \.\.\.", self.comment)
        return ENUMS[first[1]] if first else None


class Struct(NamedTuple):
    name: str
    comment: str
    lines: list[Declaration]

    @property
    def fields(self) -> list[Variable]:
        return [field for line in self.lines for field in line.variables]


class Function(NamedTuple):
    name: str
    result: str
    parameters: list[Variable]


class Header:
    """The declarations of punctura.h. SystemExit: a declaration of another form, so that none is left out silently."""

    def __init__(self, text: str) -> None:
        self.abi = int(re.findall(r"#define PUNCTURA_ABI (\d+)", text)[0])
        self.enums: dict[str, list[str]] = {}  # the words, numbered from 0
        self.handles: list[str] = []
        self.structs: list[Struct] = []
        self.functions: list[Function] = []
        text = re.sub(r"(?m)^(#.*|extern \"C\" \{|\}$)", "", text)
        at, comment = 0, ""
        while at < len(text):
            found = DECLARATION.match(text, at)
            if not found:
                raise SystemExit(
                    f"punctura.h: make_c_bindings.py cannot read the declaration at: {text[at : at + 80]!r}"
                )
            at = found.end()
            if found["comment"]:
                comment = plain(found["comment"])
            elif found["words"]:
                self.add_enum(found["words"])
            elif found["handle"]:
                self.handles.append(found["handle"])
            elif found["struct"]:
                lines = [Declaration(variables(line), plain(note)) for line, note in FIELDS.findall(found["fields"])]
                self.structs.append(Struct(found["struct"], comment, lines))
            elif found["function"]:
                given = [v for part in found["parameters"].split(",") if part != "void" for v in variables(part)]
                self.functions.append(Function(found["function"], found["result"].removeprefix("punctura_"), given))
            if not found[0].isspace() and not found["comment"]:
                comment = ""

    def add_enum(self, text: str) -> None:
        words = re.findall(r"PUNCTURA_(\w+) = (\d+)", text)
        if [int(number) for _, number in words] != list(range(len(words))) or words[0][0] not in ENUMS:
            raise SystemExit(f"punctura.h: the enumeration of {words[0][0]} has no name in ENUMS, or gaps")
        name = ENUMS[words[0][0]]
        self.enums[name] = [word.removeprefix(f"{name.upper()}_").lower() for word, _ in words]

    def used_by(self, binding: str) -> tuple[list[Function], list[Struct]]:
        functions = [f for f in self.functions if re.search(rf"\b{f.name}\b", binding)]
        taken = {p.kind for f in functions for p in f.parameters}
        structs = [s for s in self.structs if s.name in taken and re.search(rf"\b{pascal(s.name)}\b", binding)]
        return functions, structs


def plain(comment: str) -> str:
    return " ".join(re.sub(r"\n\s*\*", " ", comment).split())


def variables(declaration: str) -> list[Variable]:
    """Of `const double* x`, or of `double tip[3], force[3]`."""
    found = VARIABLES.fullmatch(" ".join(declaration.split()))
    if not found:
        raise SystemExit(f"punctura.h: make_c_bindings.py cannot read {declaration!r}")
    const, kind, pointers, names = found.groups()
    parts = [name.rstrip("]").partition("[") for name in names.split(", ")]
    return [Variable(bool(const), kind, len(pointers), name, int(length or 0)) for name, _, length in parts]


def pascal(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_"))


def camel(name: str) -> str:
    return name[0] + pascal(name)[1:]


# ---- C# ----

CS = {"double": "double", "int32_t": "int", "uint32_t": "uint", "uint64_t": "ulong", "size_t": "UIntPtr",
      "status": "int", "void": "void", "const char*": "IntPtr"}  # fmt: skip


def csharp(header: Header) -> str:
    functions, structs = header.used_by((FOLDER / "csharp/Punctura.cs").read_text(encoding="utf-8"))
    emitted = [s.name for s in structs]

    def parameter(p: Variable, f: Function) -> str:
        match p:
            case Variable(kind="char" | "void", pointers=1):
                kind = "byte[]"
            case Variable(pointers=2):
                kind = "out IntPtr"
            case Variable(kind="double", length=3):
                kind = "ref Triple" if p.const else "out Triple"
            case Variable(kind="double", pointers=1):
                kind = "double[]" if "count" in [other.name for other in f.parameters] else "out double"
            case Variable(pointers=0, length=0):
                kind = CS[p.kind]
            case Variable() if p.kind in header.handles and not f.name.endswith("_free"):
                kind = pascal(p.kind)
            case Variable() if p.kind in emitted:
                kind = ("out " if f.name.endswith("_init") else "ref ") + pascal(p.kind)
            case _:
                kind = "IntPtr"
        return f"{kind} {p.name}"

    def line(declared: Declaration, hidden: bool) -> str:
        first = declared.variables[0]
        kind = "IntPtr" if first.pointers else "Triple" if first.length == 3 else declared.enum or CS[first.kind]
        names = ", ".join(pascal(RENAMED.get(field.name, field.name)) for field in declared.variables)
        access = "internal" if hidden or first.name == "struct_size" else "public"
        comment = f"  // {declared.comment}" if declared.comment and not declared.enum else ""
        return f"        {access} {kind} {names};{comment}\n"

    def struct(s: Struct) -> str:
        hidden = any(field.pointers for field in s.fields)
        summary = f"    /// <summary>{s.comment}</summary>\n" if s.comment else ""
        head = f"    {'internal' if hidden else 'public'} partial struct {pascal(s.name)}\n    {{\n"
        body = "".join(line(declared, hidden) for declared in s.lines)
        return f"{summary}    [StructLayout(LayoutKind.Sequential)]\n{head}{body}    }}\n"

    def enum(name: str) -> str:
        access = "internal" if name == "Status" else "public"
        return f"    {access} enum {name} {{ {', '.join(map(pascal, header.enums[name]))} }}\n"

    def function(f: Function) -> str:
        given = ", ".join(parameter(p, f) for p in f.parameters)
        head = "        [DllImport(Library, CallingConvention = C)] internal static extern"
        return f"{head} {CS[f.result]} {f.name}({given});\n"

    head = f"{MADE}using System;\nusing System.Runtime.InteropServices;\n\nnamespace Punctura\n{{\n"
    native = f"""    internal static class Native
    {{
        internal const int Abi = {header.abi};
        const string Library = "punctura";
        const CallingConvention C = CallingConvention.Cdecl;
"""
    types = "\n".join(["".join(map(enum, header.enums)), *map(struct, structs), native])
    return f"{head}{types}{''.join(map(function, functions))}    }}\n}}\n"


# ---- Rust ----

RUST = {"double": "f64", "int32_t": "i32", "uint32_t": "u32", "uint64_t": "u64", "size_t": "usize", "status": "i32",
        "char": "c_char", "void": "c_void"}  # fmt: skip


def rust(header: Header) -> str:
    functions, structs = header.used_by((FOLDER / "rust/src/lib.rs").read_text(encoding="utf-8"))
    types = RUST | {name: pascal(name) for name in [*header.handles, *(s.name for s in structs)]}

    def kind(v: Variable, parameter: bool = True) -> str:
        name = types.get(v.kind, "c_void")
        if v.length and not parameter:
            return f"[{name}; {v.length}]"
        stars = ["*const" if v.const else "*mut"] * bool(v.pointers or v.length)
        return " ".join([*["*mut"] * (v.pointers - 1), *stars, name])

    def line(declared: Declaration) -> str:
        comment = declared.comment
        if declared.enum:
            comment = ", ".join(f"{i} {word}" for i, word in enumerate(header.enums[declared.enum]))
        elif comment and len(declared.variables) > 1:
            comment = f"{', '.join(field.name for field in declared.variables)}: {comment}"
        made = f"    /// {comment}\n" if comment else ""
        for field in declared.variables:
            access = "pub(crate)" if field.name == "struct_size" else "pub"
            made += f"    {access} {RENAMED.get(field.name, field.name)}: {kind(field, parameter=False)},\n"
        return made

    def struct(s: Struct) -> str:
        doc = f"/// {s.comment}\n" if s.comment else ""
        head = f"#[repr(C)]\n#[derive(Clone, Copy, Debug)]\npub struct {pascal(s.name)} {{\n"
        return f"{doc}{head}{''.join(map(line, s.lines))}}}\n\n"

    def function(f: Function) -> str:
        given = ", ".join(f"{p.name}: {kind(p)}" for p in f.parameters)
        result = {"void": "", "const char*": " -> *const c_char"}.get(f.result, f" -> {RUST.get(f.result)}")
        return f"    pub fn {f.name}({given}){result};\n"

    constants = [f"pub const {word.upper()}: i32 = {i};\n" for i, word in enumerate(header.enums["Status"])]
    used = [h for h in header.handles if any(p.kind == h for f in functions for p in f.parameters)]
    handles = [f"#[repr(C)]\npub struct {pascal(name)} {{\n    _opaque: [u8; 0],\n}}\n\n" for name in used]
    head = (
        f"{MADE}#![allow(dead_code)]\n\nuse std::os::raw::{{c_char, c_void}};\n\npub const ABI: i32 = {header.abi};\n"
    )
    types_text = "".join([*constants, "\n", *handles, *map(struct, structs)])
    return f'{head}{types_text}extern "C" {{\n{"".join(map(function, functions))}}}\n'


# ---- JavaScript ----

JS = {"double": "Float64", "int32_t": "Int32", "uint32_t": "Uint32", "uint64_t": "BigUint64"}
SIZES = {"double": 8, "int32_t": 4, "uint32_t": 4, "uint64_t": 8, "char": 1}


def layout(struct: Struct, pointer: int) -> tuple[int, list[int]]:
    """The size of a struct and the offsets of its fields, bytes. `pointer`: size of a pointer and of size_t."""
    at, widest, offsets = 0, 1, []
    for field in struct.fields:
        size = pointer if field.pointers or field.kind == "size_t" else SIZES[field.kind]
        at += -at % size
        offsets.append(at)
        at += size * max(1, field.length)
        widest = max(widest, size)
    return at + -at % widest, offsets


def constant(name: str) -> str:
    return re.sub("(?<=[a-z])(?=[A-Z])", "_", name).upper()


def javascript(header: Header) -> str:
    """For each struct its size, and the code that reads or writes it."""
    texts = [MADE, "// In wasm32. memory: Memory of memory.mjs.\n"]
    for name, words in header.enums.items():
        texts.append(f"export const {constant(name)} = {json.dumps(words)};\n")
    for struct in header.structs:
        if any(field.kind == "char" for field in struct.fields):
            continue  # a scene comes as text
        size, offsets = layout(struct, pointer=4)
        enums = [line.enum for line in struct.lines for _ in line.variables]
        read, write, fields = "", "", ""
        for field, at, enum in list(zip(struct.fields, offsets, enums, strict=True))[1:]:  # without struct_size
            key, kind, place = camel(field.name), JS[field.kind], f"at + {at}"
            value = f"memory.triple({place})" if field.length else f"view.get{kind}({place}, true)"
            read += f"  {key}: {f'{constant(enum)}[{value}]' if enum else value},\n"
            put = f"memory.put(from.{key}, {place})" if field.length else f"view.set{kind}({place}, from.{key}, true)"
            write += f"  {put};\n"
            fields += f'  {field.name}: [{at}, "{kind}"],\n'
        upper = struct.name.upper()
        texts.append(f"export const {upper} = {size}; // bytes\n")
        if struct.name == "limits":  # a caller gives some of them, with the keys of a limits file
            texts.append(f"/** Offset and type. */\nexport const LIMIT_FIELDS = {{\n{fields}}};\n")
        elif struct.name == "sample":
            texts.append(
                f"export const writeSample = (memory, at, from) => {{\n  const {{ view }} = memory;\n{write}}};\n"
            )
        else:
            texts.append(
                f"export const read{pascal(struct.name)} = (memory, at, {{ view }} = memory) => ({{\n{read}}});\n"
            )
    return "".join(texts)


def main(argv: list[str] | None = None) -> int:
    header = Header((ROOT / "capi/include/punctura.h").read_text(encoding="utf-8"))
    files = {"csharp/Native.cs": csharp, "rust/src/ffi.rs": rust, "wasm/structs.mjs": javascript}
    return write(__file__, __doc__, {f"integrations/{name}": make(header) for name, make in files.items()}, argv)


if __name__ == "__main__":
    sys.exit(main())
