"""The build back-end for pip, tools/build_backend, with an artificial PATH and scikit-build-core."""

import os
import subprocess
import sys
from pathlib import Path

import native_tools
import pytest

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the compilers and npm are shell scripts")

NPM = """#!/bin/sh
echo "$*" >>"{log}"
case "$1" in
  ci) mkdir -p node_modules && echo much >node_modules/much ;;
  run) mkdir -p ../python/punctura/studio/page && echo page >../python/punctura/studio/page/index.html ;;
esac
"""
HOOK = (
    "import sys; sys.path.insert(0, sys.argv[1]); import page_backend; print(getattr(page_backend, sys.argv[2])('.'))"
)


class Pip:
    """Calls a hook of the back-end in a separate tree, like pip. `native.txt` exists if CMake was started."""

    def __init__(self, folder: Path) -> None:
        self.tree, self.path, self.stubs = folder / "tree", folder / "bin", folder / "stubs"
        for name in ("index.html", "package.json", "package-lock.json", "src/main.ts"):
            file = self.tree / "web" / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(name)
        (self.stubs / "scikit_build_core").mkdir(parents=True)
        (self.stubs / "scikit_build_core/__init__.py").write_text("")
        hooks = ("build_wheel", "build_editable", "build_sdist")
        (self.stubs / "scikit_build_core/build.py").write_text(
            "".join(f"def {hook}(*_):\n    open('native.txt', 'w').close()\n    return 'made'\n" for hook in hooks)
        )
        self.path.mkdir()
        for name in ("sh", "mkdir", "echo"):
            (self.path / name).symlink_to(f"/bin/{name}")
        self.script("node", "#!/bin/sh\necho v24.19.0\n")
        self.script("npm", NPM.format(log=folder / "npm.log"))
        self.npm_log = folder / "npm.log"

    def script(self, name: str, text: str) -> None:
        (self.path / name).write_text(text)
        (self.path / name).chmod(0o755)

    def call(self, hook: str = "build_wheel", **environment: str) -> subprocess.CompletedProcess[str]:
        keep = ("CXX", "CMAKE_ARGS", "CMAKE_TOOLCHAIN_FILE", "PUNCTURA_KEEP_NODE_MODULES")
        clean = {key: value for key, value in os.environ.items() if key not in keep}
        command = [sys.executable, "-c", HOOK, str(ROOT / "tools/build_backend"), hook]
        env = clean | {"PATH": str(self.path), "PYTHONPATH": str(self.stubs)} | environment
        return subprocess.run(command, cwd=self.tree, env=env, capture_output=True, text=True, check=False)

    @property
    def native_started(self) -> bool:
        return (self.tree / "native.txt").exists()


@pytest.fixture
def pip(tmp_path: Path) -> Pip:
    return Pip(tmp_path)


@pytest.fixture
def pip_with_compiler(pip: Pip) -> Pip:
    pip.script("c++", "#!/bin/sh\nexit 0\n")
    return pip


@pytest.mark.parametrize("hook", ["build_wheel", "build_editable"])
def test_without_a_compiler_pip_says_what_to_install_before_anything_is_built(pip: Pip, hook: str) -> None:
    done = pip.call(hook)
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert "there is no C++ compiler" in done.stderr
    assert any(line in done.stderr for line in ("apt-get install g++", "dnf install gcc-c++", "xcode-select --install"))
    assert not pip.native_started and not pip.npm_log.exists()


def test_an_sdist_needs_no_compiler(pip: Pip) -> None:
    assert pip.call("build_sdist").stdout == "made\n"


def test_a_compiler_too_old_for_cpp_20_is_told_in_its_own_words(pip: Pip) -> None:
    pip.script("c++", "#!/bin/sh\necho \"c++: error: unrecognized command line option '-std=c++20'\" >&2\nexit 1\n")
    done = pip.call()
    assert done.returncode == 1 and not pip.native_started
    assert "not a C++20 compiler (c++: error: unrecognized" in done.stderr


def test_a_cxx_that_does_not_start_is_told_by_its_name(pip_with_compiler: Pip) -> None:
    done = pip_with_compiler.call(CXX="no-such-compiler -m64")
    assert done.returncode == 1 and not pip_with_compiler.native_started
    assert "CXX=no-such-compiler -m64 does not start" in done.stderr and "leave CXX unset" in done.stderr


@pytest.mark.parametrize(
    "environment", [{"CMAKE_ARGS": "-DCMAKE_CXX_COMPILER=/opt/cc"}, {"CMAKE_TOOLCHAIN_FILE": "/t"}]
)
def test_a_compiler_that_is_named_to_cmake_is_left_to_cmake(pip: Pip, environment: dict[str, str]) -> None:
    assert pip.call(**environment).returncode == 0 and pip.native_started


def test_python_headers_that_are_missing_are_reported(pip_with_compiler: Pip, tmp_path: Path) -> None:
    code = "import sysconfig; sysconfig.get_path = lambda *_: '/nowhere'\n"
    (pip_with_compiler.stubs / "sitecustomize.py").write_text(code)
    done = pip_with_compiler.call()
    assert done.returncode == 1 and "Python's headers are missing (/nowhere/Python.h)" in done.stderr


REMEDIES = [
    ("ID=ubuntu\nID_LIKE=debian\n", "sudo apt-get install g++ python3-dev"),
    ('ID="rhel"\nID_LIKE="fedora"\n', "sudo dnf install gcc-c++ python3-devel"),
    ('ID="opensuse-leap"\nID_LIKE="suse opensuse"\n', "sudo zypper install gcc-c++ python3-devel"),
    ("ID=arch\n", "sudo pacman -S gcc"),
    ("ID=alpine\n", "sudo apk add g++ python3-dev"),
]


@pytest.mark.parametrize(("release", "line"), REMEDIES)
@pytest.mark.skipif(sys.platform == "darwin", reason="macOS has one remedy")
def test_the_remedy_is_the_line_of_this_system(
    release: str, line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(native_tools, "OS_RELEASE", tmp_path / "os-release")
    (tmp_path / "os-release").write_text(f"NAME=x\n{release}")
    assert native_tools.remedy().strip() == line
    (tmp_path / "os-release").write_text("ID=plan9\n")
    assert all(remedy in native_tools.remedy() for _, remedy in REMEDIES)


def test_pip_leaves_no_node_modules_in_the_clone(pip_with_compiler: Pip) -> None:
    assert pip_with_compiler.call().stdout == "made\n"
    assert (pip_with_compiler.tree / "python/punctura/studio/page/index.html").exists()
    assert pip_with_compiler.npm_log.read_text().startswith("ci "), "they were there meanwhile"
    assert not (pip_with_compiler.tree / "web/node_modules").exists()


def test_node_modules_that_were_there_stay(pip_with_compiler: Pip) -> None:
    theirs = pip_with_compiler.tree / "web/node_modules/theirs"
    theirs.parent.mkdir()
    theirs.write_text("x")
    assert pip_with_compiler.call().returncode == 0
    assert theirs.exists()


def test_the_tests_keep_node_modules_for_their_next_build(pip_with_compiler: Pip) -> None:
    assert pip_with_compiler.call(PUNCTURA_KEEP_NODE_MODULES="1").returncode == 0
    assert (pip_with_compiler.tree / "web/node_modules/much").exists()
    assert "PUNCTURA_KEEP_NODE_MODULES=1" in (ROOT / "tools/setup.sh").read_text()


def test_a_page_that_cannot_be_built_leaves_no_node_modules_either(pip_with_compiler: Pip) -> None:
    npm = '#!/bin/sh\nif [ "$1" = ci ]; then mkdir -p node_modules; else exit 1; fi\n'
    pip_with_compiler.script("npm", npm)
    done = pip_with_compiler.call()
    assert done.returncode == 1 and "page cannot be built" in done.stderr
    assert not (pip_with_compiler.tree / "web/node_modules").exists()
