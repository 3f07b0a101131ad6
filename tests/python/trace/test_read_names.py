# ruff: noqa: RUF001  # names in other letters
"""Names, units, encodings and numbers as the makers and users of testing machines write them."""

import numpy as np
import pytest
from punctura.trace import TraceError, read_trace
from punctura.trace.units import UNITS, unit_of
from traces import trace

MADE = trace()
SAMPLES = list(zip(MADE.time.tolist(), MADE.depth.tolist(), MADE.force.tolist(), strict=True))


def written(head, depth="mm", force="N", time="s", order="tdf", mark="\t", cell=repr):
    """A text file: the lines of the head, then a row for each sample, in these units."""
    columns = {
        "t": MADE.time / UNITS["time"][time],
        "d": MADE.depth / UNITS["depth"][depth],
        "f": MADE.force / UNITS["force"][force],
    }
    rows = zip(*(columns[key] for key in order), strict=True)
    return head + "\n" + "\n".join(mark.join(cell(float(value)) for value in row) for row in rows) + "\n"


def check(path, rel=1e-9, **stated):
    read = read_trace(path, **stated)
    assert read.depth == pytest.approx(MADE.depth, rel=rel, abs=1e-9)
    assert read.force == pytest.approx(MADE.force, rel=rel, abs=1e-6)
    assert read.time - read.time[0] == pytest.approx(MADE.time - MADE.time[0], rel=rel, abs=1e-6)
    return read


HEADS = {
    "gram-force": written("Force (g)\tDistance (mm)\tTime (sec)", force="gf", order="fdt"),
    "pounds": written("Time (sec),Extension (in),Load (lb)", "in", "lbf", mark=","),
    "capitals": written("TIME(MS),DEPTH(MM),FORCE(KN)", force="kN", time="ms", mark=","),
    "Greek mu": written("Time (s),Depth (\u03bcm),Force (\u00b5N)", "um", "uN", mark=","),
    "row of units": written("Axial Displacement\tAxial Force\tTime\nmm\tN\tSec", order="dft"),
    "French": written("Temps (s);Déplacement (mm);Force (N)", mark=";", cell=lambda x: repr(x).replace(".", ",")),
    "French of Zwick": written("Temps d'essai;Force standard;Allongement\ns;N;mm", order="tfd", mark=";"),
    "Spanish": written("Tiempo (s);Desplazamiento (mm);Fuerza (cN)", force="cN", mark=";"),
    "Italian": written("Tempo [s];Spostamento [mm];Carico [kg]", force="kgf", mark=";"),
    "German": written("Prüfzeit/s;Traversenweg/mm;Prüfkraft in mN", force="mN", mark=";"),
    "Japanese": written("時間(秒)\tストローク(mm)\t試験力(N)"),
    "Chinese": written("时间（s）\t位移（mm）\t试验力（kN）", force="kN"),
    "Anton Paar": written("Time (s)\tPd (µm)\tFn (mN)\tFnRef (mN)", "um", "mN", order="tdff"),
    "a mark behind the last column": written("Time (s)\tDepth (mm)\tForce (N)")
    .replace("\n", "\t\n")
    .replace(")\t\n", ")\n"),
    "a mass and an acceleration": written("Time (s),Depth (mm),Force (N),Sample (g),ax (g)", order="tdfdt", mark=","),
    "capital between words": written("timeUs,depthMm,forceN", time="us", mark=","),
    "a balance and the time of a computer": written("Unix time (s),Depth (mm),Weight (g)", force="gf", mark=","),
    "units of one letter as names": written("s,mm,N", mark=","),
    "units of an Arduino": written("millis,depth_mm,weight_g", force="gf", time="ms", mark=","),
    "two spaces between names above tabs": written("Time [s]  Depth [um]  Force [mN]", "um", "mN"),
    "a long report above": "".join(f"step {i}: held\n" for i in range(300)) + written("t (s);z (mm);f (N)", mark=";"),
    "units as names": written("sec,in,ozf", "in", "ozf", mark=","),
    "a name of somebody": written("run (s),tip went to (mil),felt (dyn)", "mil", "dyn", mark=","),
}


@pytest.mark.parametrize("what", HEADS)
def test_names_and_units_are_known(tmp_path, what):
    (tmp_path / "a.csv").write_text(HEADS[what], encoding="utf-8")
    read = check(tmp_path / "a.csv")
    assert {one.kind for one in read.findings} == (
        {"column_by_unit"} if what.startswith(("a name", "units")) else set()
    )


def test_every_unit_is_known_in_small_and_capital_letters():
    for units in UNITS.values():
        assert all(unit_of(unit) == unit == unit_of(f"[{unit}]") for unit in units)
    assert [unit_of(text) for text in ("MM", "Sec.", "lbs", "KN", "µm", "OZ")] == ["mm", "s", "lbf", "kN", "um", "ozf"]
    assert [unit_of(text) for text in ("MN", "Nm", "furlong", "")] == ["", "", "", ""]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("Force (V)", "'V' is no unit of the force"),
        ("Load [counts]", "'counts' is no unit of the force"),
        ("force_min", "no column is known to be the force"),
        ("Peak force (Nm)", "no column is known to be the force"),
    ],
)
def test_a_unit_of_something_else_hides_no_name_and_is_not_read(tmp_path, name, text):
    (tmp_path / "a.csv").write_text(written(f"time_s,depth_mm,{name}", mark=","))
    with pytest.raises(TraceError, match=text):
        read_trace(tmp_path / "a.csv")
    check(tmp_path / "a.csv", columns={"force": 3}, units={"force": "N"})


def test_all_that_is_missing_is_asked_at_once(tmp_path):
    (tmp_path / "a.csv").write_text(written("a,depth,force", mark=","))
    with pytest.raises(TraceError) as error:
        read_trace(tmp_path / "a.csv")
    assert "--unit depth=UNIT" in str(error.value) and "--unit force=UNIT" in str(error.value)
    (tmp_path / "b.csv").write_text(written("a,b,c", mark=","))
    with pytest.raises(TraceError) as error:
        read_trace(tmp_path / "b.csv")
    options = ("--column depth=NAME", "--unit depth=UNIT", "--column force=NAME", "--unit force=UNIT")
    assert all(option in str(error.value) for option in options)


def test_the_same_column_twice_is_no_doubt_and_an_axis_at_rest_is_no_force(tmp_path):
    (tmp_path / "a.csv").write_text(
        written("time_s,Extension (mm),Load (N),Compressive extension (mm)", order="tdfd", mark=",")
    )
    check(tmp_path / "a.csv")
    rows = [f"{1e3 * t!r},{1.7e9 + t!r},{d * 1e3!r},{f!r},{d * 1e3 + 120!r}" for t, d, f in SAMPLES]
    head = "Elapsed (ms),Timestamp (s),Travel (mm),Load (N),Crosshead (mm)"  # with other zeros
    (tmp_path / "c.csv").write_text("\n".join([head, *rows]))
    check(tmp_path / "c.csv")
    head = "%time,field.header.seq,field.wrench.force.x,field.wrench.force.y,field.wrench.force.z,depth"
    rows = [f"{1_700_000_000_000_000_000 + round(1e9 * t)},1,0.1,0.2,{f!r},{d!r}" for t, d, f in SAMPLES]
    (tmp_path / "b.csv").write_text("\n".join([head, *rows]))
    check(tmp_path / "b.csv", units={"depth": "m", "force": "N"})


@pytest.mark.parametrize(
    ("head", "role"),
    [
        ("time_s,x_mm,y_mm,Fz (N)", "depth"),
        ("time_s,Crosshead (mm),LVDT (mm),force_N", "depth"),
        ("time_s,Fx (N),Fy (N),depth_mm", "force"),
    ],
)
def test_axes_and_gauges_that_differ_are_asked_for(tmp_path, head, role):
    rows = [f"{t},{d},{d * d},{f}" if role == "depth" else f"{t},{f},{f * f},{d}" for t, d, f in SAMPLES]
    (tmp_path / "a.csv").write_text("\n".join([head, *rows]))
    with pytest.raises(TraceError, match=f"more than one column could be the {role}"):
        read_trace(tmp_path / "a.csv")


ENCODINGS = {
    "gbk": "时间(s),位移(mm),力(N)",
    "gb18030": "试验力(N)x,位移值（mm）,试验力(N),时间(s)",
    "big5": "時間(s),位移(mm),荷重(N)",
    "shift_jis": "時間(s),変位(mm),荷重(N)",
    "euc_jp": "時間(s),ストローク(mm),試験力(N)",
    "cp949": "시간(초),변위(mm),하중(N)",
    "cp1252": "Temps (s),Déplacement (mm),Force (N)",
    "mac_roman": "Temps (s),Déplacement (mm),Force (N)",
    "cp1251": "Время (с),Перемещение (мм),Сила (Н)",
    "utf-16-le": "Time (s),Depth (mm),Force (N)",
    "utf-16-be": "Time (s),Depth (mm),Force (N)",
    "utf-8-sig": "时间(s),位移(mm),力(N)",
}


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_the_encoding_is_the_one_in_which_the_names_are_known(tmp_path, encoding):
    head = ENCODINGS[encoding]
    order = "fdft" if encoding == "gb18030" else "tdf"
    (tmp_path / "a.csv").write_bytes(written(head, order=order, mark=",").encode(encoding))
    assert not check(tmp_path / "a.csv").findings


def test_an_encoding_that_nothing_shows_is_named_and_can_be_stated(tmp_path):
    (tmp_path / "a.csv").write_bytes(written("甲乙(s),丙丁(mm),戊己(N)", mark=",").encode("gbk"))
    findings = check(tmp_path / "a.csv").findings
    assert findings[0].kind == "encoding" and "--encoding" in findings[0].text
    assert "甲乙" in check(tmp_path / "a.csv", encoding="gbk").findings[2].text
    with pytest.raises(TraceError, match=r"'klingon' is no encoding; .*--encoding NAME"):
        read_trace(tmp_path / "a.csv", encoding="klingon")


def grouped(between, mark):
    return lambda x: f"{x:,.3f}".replace(",", "\0").replace(".", mark).replace("\0", between)


@pytest.mark.parametrize("between", ["\u202f", "\u00a0", "\u2009", " ", "'", "\u2019", ".", ","])
@pytest.mark.parametrize("mark", [".", ","])
def test_thousands_are_read_with_any_mark_between_them(tmp_path, between, mark):
    if between == mark:
        between = {".": ",", ",": "."}[mark]
    text = written("time_ms;depth_um;force_mN", "um", "mN", "ms", mark=";", cell=grouped(between, mark))
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    read = read_trace(tmp_path / "a.csv")
    assert len(read) == len(MADE) and read.force == pytest.approx(MADE.force, abs=1e-5)


def test_a_comma_between_thousands_is_known_beside_decimal_points(tmp_path):
    cells = iter(range(3 * len(MADE)))  # only the time, in each first cell of a row, has thousands
    text = written(
        "time_ms;depth_mm;force_N",
        time="ms",
        mark=";",
        cell=lambda x: f"{x:,.0f}" if next(cells) % 3 == 0 else f"{x:.6f}",
    )
    (tmp_path / "a.csv").write_text(text)
    check(tmp_path / "a.csv", rel=1e-4)


@pytest.mark.parametrize(("between", "mark"), [(",", "\t"), (",", '","'), (".", ";")])
def test_whole_numbers_below_a_thousand_show_the_mark_between_thousands(tmp_path, between, mark):
    text = written("time_ms;depth_um;force_mN".replace(";", mark), "um", "mN", "ms", mark=mark,
                   cell=lambda x: f"{x:,.0f}".replace(",", between))  # fmt: skip
    quoted = "\n".join(f'"{line}"' for line in text.splitlines())
    (tmp_path / "a.csv").write_text(quoted if '"' in mark else text)
    read = read_trace(tmp_path / "a.csv", decimal="," if between == "." else None)
    assert read.depth == pytest.approx(MADE.depth, abs=1e-6) and read.force == pytest.approx(MADE.force, abs=1e-3)
    if between == ".":
        with pytest.raises(TraceError, match="a decimal point, or does it separate thousands"):
            read_trace(tmp_path / "a.csv")


def test_many_lost_rows_are_severe_and_nothing_else_is_concluded(tmp_path):
    lines = written("time_s,depth_mm,force_N", mark=",").splitlines()
    for i in range(800, 1000):
        lines[i] = lines[i].replace(",", ",~", 1)
    (tmp_path / "a.csv").write_text("\n".join(lines))
    [finding] = read_trace(tmp_path / "a.csv").findings
    assert finding.kind == "rows_without_numbers" and finding.severe and "200 of" in finding.text


def test_a_specimen_ends_where_the_ones_beside_it_go_on(tmp_path):
    lines = written("time_s,depth_mm,force_N,other_mm,other_N", mark=",").splitlines()
    longer = [f"{line},0,0" if i else line for i, line in enumerate(lines)] + [f",,,{i},1" for i in range(2000)]
    (tmp_path / "a.csv").write_text("\n".join(longer))
    read = check(tmp_path / "a.csv", columns={"depth": "2", "force": "3"})
    assert [one.kind for one in read.findings] == ["shorter"]
    assert "the last 2000 rows" in read.findings[0].text and not read.findings[0].severe


def test_intervals_of_a_rheometer_and_blocks_of_a_testing_machine_are_one_trace(tmp_path):
    lines = written("", order="tdf").splitlines()[1:]
    again = ["", "Interval data:\tPoint No.\tTime\tTravel\tNormal Force\tStatus", "\t[]\t[s]\t[mm]\t[N]\t[]"]
    rows = [f"\t{i}\t{line}\tDy_auto" for i, line in enumerate(lines, 1)]
    text = "\n".join(
        ["Project:\tx", "Interval and data points:\t2\t700\t700", *again, *rows[:700], *again, *rows[700:]]
    )
    (tmp_path / "a.csv").write_text(text.replace(".", ",") + "\n", encoding="utf-16")
    assert [one.kind for one in check(tmp_path / "a.csv").findings] == ["rows_without_numbers"]
    again = ["", "Data Acquisition:\tTimed\tTime:\t3\tSec", "Time\tAxial Displacement\tAxial Force", "Sec\tmm\tN"]
    (tmp_path / "b.txt").write_text("\n".join(["Station Name:\tx", *again, *lines[:700], *again, *lines[700:]]))
    assert [one.kind for one in check(tmp_path / "b.txt").findings] == ["rows_without_numbers"]


def clock(start, seconds, date=""):
    at = start + seconds
    return f"{date}{int(at // 3600) % 24:02d}:{int(at // 60) % 60:02d}:{at % 60:06.3f}"


@pytest.mark.parametrize("date", ["", "2026-05-02 ", "2026-05-02T", "02.05.2026 "])
@pytest.mark.parametrize("start", [45000.0, 86398.0])  # s; over midnight, too
def test_a_time_of_day_is_a_time(tmp_path, date, start):
    head = "Time (HH:mm:ss),Depth (mm),Force (N)"
    rows = [f"{clock(start, t, date)},{d * 1e3!r},{f!r}" for t, d, f in SAMPLES]
    (tmp_path / "a.csv").write_text("\n".join([head, *rows]))
    assert not check(tmp_path / "a.csv").findings


LVM = """LabVIEW Measurement\t
Writer_Version\t2
Reader_Version\t2
Separator\tTab
Decimal_Separator\t{mark}
Multi_Headings\tYes
X_Columns\t{columns}
Time_Pref\tRelative
Date\t2026/05/02
Time\t12:00:00
***End_of_Header***\t
\t
Channels\t2\t\t
Samples\t1400\t1400\t
Date\t2026/05/02\t2026/05/02\t
Time\t12:00:00\t12:00:00\t
Y_Unit_Label\tMillimeters\tNewtons\t
X_Dimension\tTime\tTime\t
X0\t0{mark}0\t0{mark}0\t
Delta_X\t0{mark}005\t0{mark}005\t
***End_of_Header***\t\t\t
{names}"""


@pytest.mark.parametrize("mark", [".", ","])
@pytest.mark.parametrize(
    ("columns", "names", "order"),
    [
        ("One", "X_Value\tDepth\tForce\tComment", "tdf"),
        ("No", "X_Value\tDepth\tForce\tComment", "df"),
        ("Multi", "X_Value\tDepth\tX_Value\tForce\tComment", "tdtf"),
        ("One", "X_Value\tWeg\tKraft\tKommentar", "tdf"),
    ],
)
def test_a_labview_measurement_has_its_units_in_the_header(tmp_path, mark, columns, names, order):
    head = LVM.format(mark=mark, columns=columns, names=names)
    lines = written(head, order=order, cell=lambda x: repr(x).replace(".", mark)).splitlines()
    if columns == "No":
        lines = [*lines[:22], *("\t" + line for line in lines[22:])]
    if columns == "Multi":  # a unit for each Y, between those of X
        lines = [line.replace("Millimeters\tNewtons", "Millimeters\t\tNewtons") for line in lines]
    (tmp_path / "a.lvm").write_text("\n".join(lines))
    assert not check(tmp_path / "a.lvm").findings


def test_a_stated_unit_is_never_refused(tmp_path):
    assert np.ptp(MADE.depth) > 0.01
    (tmp_path / "a.csv").write_text(written("time_s,depth_m,force_kN", mark=","))  # wrong by 1e3
    read = read_trace(tmp_path / "a.csv")
    assert [one.kind for one in read.findings if one.severe] == [] and "wrong_unit" in {
        one.kind for one in read.findings
    }
    for depth, force in (("um", "mN"), ("mm", "N")):  # a microneedle, and a trocar
        size = {"um": 1e-2, "mm": 1.0}[depth], {"mN": 1e-3, "N": 500.0}[force]
        rows = [
            f"{t},{size[0] * d},{size[1] * f}" for t, d, f in zip(MADE.time, MADE.depth * 1e3, MADE.force, strict=True)
        ]
        (tmp_path / "b.csv").write_text("\n".join(["time_s,depth_mm,force_N", *rows]))
        assert not read_trace(tmp_path / "b.csv").findings


@pytest.mark.parametrize(
    ("names", "taken", "other"),
    [
        ("force_tip_N,force_base_N", "force_tip_N", "force_base_N"),
        ("Load (N),Force (N)", "Force (N)", "Load (N)"),
        ("Fz (N),Cell B (N)", "Fz (N)", "Cell B (N)"),
    ],
)
def test_a_second_force_is_named_beside_the_one_that_is_taken(tmp_path, names, taken, other):
    share = 0.6 if names.startswith(taken) else 1 / 0.6
    rows = [f"{t},{1e3 * d},{f},{f / 0.6}" for t, d, f in SAMPLES]
    (tmp_path / "a.csv").write_text("\n".join([f"time_s,depth_mm,{names}", *rows]))
    (finding,) = read_trace(tmp_path / "a.csv").findings
    assert finding.kind == "other_columns" and "--column force=NAME" in finding.text
    assert f"{taken!r} is taken as the force, and {other!r} could be it, too" in finding.text
    stated = read_trace(tmp_path / "a.csv", {"force": other})
    assert not stated.findings
    assert share * stated.force == pytest.approx(read_trace(tmp_path / "a.csv").force)
