"""The compilers for which a warning is an error."""

import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TESTED = ["GNU 12.2.0", "GNU 14.2.0", "Clang 14.0.6", "Clang 19.1.7"]
OTHERS = ["GNU 13.3.0", "GNU 15.1.0", "GNU 1.2", "GNU 120.1", "Clang 18.1.3", "AppleClang 14.0.3", "MSVC 19.44", " "]


def test_warnings_are_errors_only_with_a_compiler_that_the_tests_are_run_with(tmp_path: Path) -> None:
    script = tmp_path / "ask.cmake"
    asked = [compiler.split(" ") for compiler in TESTED + OTHERS]
    script.write_text(
        f'include("{ROOT}/cmake/tested_compilers.cmake")\n'
        + "".join(f'punctura_compiler_is_tested("{id}" "{at}" answer)\nmessage("${{answer}}")\n' for id, at in asked)
    )
    done = subprocess.run(["cmake", "-P", script], capture_output=True, text=True, check=True)
    assert done.stderr.split() == ["TRUE"] * len(TESTED) + ["FALSE"] * len(OTHERS)


def test_the_note_names_the_compilers_that_are_tested() -> None:
    assert "GCC 12 and 14 and Clang 14 and 19" in (ROOT / "cmake/warnings.cmake").read_text()
