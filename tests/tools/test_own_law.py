"""A law of one's own: what compiles, and what the compiler says about what does not."""

import atexit
import functools
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

pytestmark = pytest.mark.xdist_group("own_law")  # one process compiles the headers
ROOT = Path(__file__).parents[2]
HEADERS = ["<string>", "<vector>", '"punctura/punctura.hpp"', '"punctura_runtime/loop/step_maker.hpp"']
PROGRAM = """
struct Own {
  using Scalar = double;
  struct Memory { MEMORY };
  punctura::PiecewiseBand<double, 2> pieces(double, const Memory&) const noexcept { return {{0}, {}}; }
  ADVANCE
};
punctura::Proxy1d line(Own{}, punctura::Coupling{400, 1}, 1e-3);
punctura::Proxy3d space(Own{}, punctura::Vector3d(), punctura::Vector3d(0, -1, 0), punctura::Coupling{400, 1}, 1e-3);
"""
ADVANCE = "bool advance(Memory&, double) const noexcept { return true; }"


def run_compiler(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    compiler = os.environ.get("CXX") or shutil.which("c++") or shutil.which("g++") or "clang++"
    command = [compiler, "-std=c++20", f"-I{ROOT / 'core'}", f"-I{ROOT / 'runtime'}", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=300)


@functools.cache
def compiled_headers() -> Path:
    """All headers of these programs, compiled once: GCC and Clang take NAME.gch in place of NAME."""
    headers = Path(tempfile.mkdtemp()) / "headers.hpp"
    atexit.register(shutil.rmtree, headers.parent)
    headers.write_text("\n".join(f"#include {name}" for name in HEADERS))
    run_compiler("-x", "c++-header", headers, "-o", f"{headers}.gch").check_returncode()
    return headers


def checked(tmp_path: Path, program: str) -> subprocess.CompletedProcess[str]:
    source = tmp_path / "own.cpp"
    source.write_text(program)
    return run_compiler("-include", compiled_headers(), "-fsyntax-only", source)


def compiled(tmp_path: Path, memory: str, advance: str = ADVANCE) -> subprocess.CompletedProcess[str]:
    return checked(tmp_path, PROGRAM.replace("MEMORY", memory).replace("ADVANCE", advance))


def test_a_memory_inside_its_law_may_have_initial_values(tmp_path):
    done = compiled(tmp_path, "double healed = 0; bool left{true};")
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("memory", ["std::string text;", "std::vector<double> cuts;", "const int k = 1;", "int& at;"])
def test_a_memory_that_is_not_plain_numbers_is_refused_with_the_cause(tmp_path, memory):
    done = compiled(tmp_path, memory)
    assert done.returncode != 0
    assert "must be plain numbers" in done.stderr and "std::string" in done.stderr


def test_a_memory_that_is_too_large_for_the_stack_of_a_thread_is_refused(tmp_path):
    assert compiled(tmp_path, "double cuts[8192];").returncode == 0
    done = compiled(tmp_path, "double cuts[8193];")
    assert done.returncode != 0
    assert "must have at most 64 KiB" in done.stderr


@pytest.mark.parametrize(
    "advance",
    [
        "",
        "bool advance(Memory&, double) const { return true; }",
        "bool advance(Memory&, double) noexcept { return true; }",
        "void advance(Memory&, double) const noexcept {}",
    ],
)
def test_a_function_of_a_memory_in_another_form_is_refused_with_the_cause(tmp_path, advance):
    done = compiled(tmp_path, "double cut;", advance)
    assert done.returncode != 0
    assert "bool advance(Memory&, Scalar depth) const noexcept" in done.stderr


LAW = """
using namespace punctura;
struct Own {
  using Scalar = double;
  PiecewiseBand<double, 2> pieces(double) const noexcept { return {}; }
};
auto built(const Scene& scene, std::vector<Problem>& problems) {
  return try_build<double>(scene, problems, [](auto&&...) { return Own{}; });
}
Proxy1d line(Own{}, Coupling{400, 1}, 1e-3);
"""


def test_a_class_with_the_one_function_of_a_law_is_one(tmp_path):
    done = checked(tmp_path, LAW)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "change",
    [
        ("using Scalar = double;", ""),
        ("pieces(double)", "pieces()"),
        ("const noexcept", "const"),
        ("const noexcept", "noexcept"),
        ("using Scalar = double;", "using Scalar = double; private:"),
        ("return Own{};", "return std::optional(Own{});"),
    ],
)
def test_a_class_that_is_no_law_for_a_scene_is_refused_with_the_cause(tmp_path, change):
    assert LAW.count(change[0]) == 1
    done = checked(tmp_path, LAW.replace(*change))
    assert done.returncode != 0
    assert "It needs, in public: using Scalar = double" in done.stderr


def law_with(form: str) -> str:
    function = form.replace("...", "goes_on_from(const Own&)") + " { return false; }"
    program = LAW.replace("using Scalar", function + " using Scalar")
    return program + "bool same(const Own& a) { return goes_on_from(a, a); }"


def test_a_law_may_say_from_which_one_it_goes_on(tmp_path):
    done = checked(tmp_path, law_with("bool ... const noexcept"))
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("form", ["int ... const noexcept", "bool ... noexcept", "bool ... const"])
def test_a_law_that_says_from_which_one_it_goes_on_in_another_form_is_refused(tmp_path, form):
    done = checked(tmp_path, law_with(form))
    assert done.returncode != 0
    assert "bool goes_on_from(const Own& before) const noexcept" in done.stderr


MODEL = """
using namespace punctura;
struct Own {
  using Scalar = double;
  using StoredIn = HeapStorage;
  void reset() noexcept {}
  void resume(const Own&) noexcept {}
  Vector3d step(const Vector3d&, const Vector3d&) noexcept { return {}; }
  Vector3d tip() const noexcept { return {}; }
  bool uses_axis() const noexcept { return false; }
  bool outside() const noexcept { return true; }
  std::size_t size() const noexcept { return 1; }
  SpaceTick<double> tick(std::size_t) const noexcept { return {}; }
  double cos_beta(std::size_t) const noexcept { return 1; }
};
StepMaker maker([](const Scene&, std::vector<Problem>&) -> std::optional<Own> { return Own{}; });
"""


def test_a_class_with_the_functions_of_a_model_is_one(tmp_path):
    done = checked(tmp_path, MODEL)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "change",
    [
        ("const Vector3d&) noexcept", "const Vector3d&)"),
        ("std::size_t size", "int size"),
        ("bool outside() const noexcept { return true; }", ""),
        ("using StoredIn = HeapStorage;", "Own() = default; Own(Own&&) = default; using StoredIn = HeapStorage;"),
    ],
)
def test_a_class_that_is_no_model_for_a_loop_is_refused_with_the_cause(tmp_path, change):
    assert MODEL.count(change[0]) == 1
    done = checked(tmp_path, MODEL.replace(*change))
    assert done.returncode != 0
    assert "the nine functions of Model in punctura/servo/servo_step.hpp" in done.stderr
