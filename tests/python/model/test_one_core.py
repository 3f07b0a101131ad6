"""The compiled core is loaded once in a process, in its main interpreter. A second load is refused."""

import subprocess
import sys

import pytest

TICK = "punctura.Insertion(punctura.load_scene('k06-fig10')).step((0, 1e-3, 0), (0, -1, 0))"
AGAIN = f"""
import sys, punctura
first = punctura
for name in [n for n in sys.modules if n.split(".")[0] == "punctura"]:
    del sys.modules[name]
try:
    import punctura
except ImportError as error:
    print(error)
punctura = first
sys.modules.update({{"punctura": first, "punctura._core": first._core}})
{TICK}
"""
SUB = f"""
import _xxsubinterpreters as interpreters
import punctura
for isolated in (True, False):
    one = interpreters.create(isolated=isolated)
    try:
        interpreters.run_string(one, "import punctura")
    except interpreters.RunFailedError as error:
        print(error)
    interpreters.destroy(one)
{TICK}
"""
FIRST = SUB.replace("import punctura\nfor", "for").replace(TICK, f"import punctura\n{TICK}")


# Since 3.12, Python itself refuses subinterpreters to a module that does not say that it works in them.
PROGRAMS = {"again": AGAIN} | ({"sub": SUB, "sub first": FIRST} if sys.version_info < (3, 12) else {})


@pytest.mark.parametrize("program", PROGRAMS.values(), ids=PROGRAMS)
def test_a_second_core_is_refused_with_a_sentence_and_the_first_goes_on(program):
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert ("not in a subinterpreter" if program != AGAIN else "imported before in this process") in done.stdout
