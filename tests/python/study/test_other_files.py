"""The files in the folder of a study that are not of its plan, or have changed since."""

from collections.abc import Callable
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from punctura.study import StudyError, load_plan, replay_row, run_study
from punctura.study.folder import StudyWarning
from studies import GRID, in_chunks, with_report, written

OTHER = GRID.replace("0.2, 0.3]", "0.2, 0.31]")


def contents(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file() and path.name != "lock"}


@pytest.mark.parametrize(
    ("joined", "mark"), [(True, None), (False, None), (False, b""), (False, b"[]"), (True, b'{"digest": 3}')]
)
def test_the_files_state_their_plan_without_study_json(
    tmp_path: Path, joined: bool, mark: bytes | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, plan = tmp_path / "out", load_plan(written(tmp_path, GRID))
    if joined and mark is None:
        with_report(monkeypatch)
    if joined:
        run_study(plan, out)
    else:
        in_chunks(plan, out, monkeypatch)
    (out / "study.json").unlink() if mark is None else (out / "study.json").write_bytes(mark)
    before = contents(out)
    name = "trials" if joined else "chunk-000000"
    for foreign in (run_study, lambda plan, out: replay_row(plan, 1, out)):
        with pytest.raises(StudyError, match=rf"{name}\.parquet holds the trials of another plan.*Give another --out"):
            foreign(load_plan(written(tmp_path, OTHER)), out)
    assert contents(out) == before
    assert run_study(load_plan(written(tmp_path, GRID)), out).kept == 6
    assert (out / "study.json").read_bytes() not in (b"", mark)


def changed(path: Path, change: Callable[[pa.Table], pa.Table]) -> None:
    pq.write_table(change(pq.read_table(path)), path)


@pytest.mark.parametrize("name", ["trials.parquet", "chunk-000002.parquet"])
def test_a_file_that_does_not_state_its_plan_is_refused_by_name(
    tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, plan = tmp_path / "out", load_plan(written(tmp_path, GRID))
    in_chunks(plan, out, monkeypatch)
    if name == "trials.parquet":
        run_study(plan, out)
    changed(out / name, lambda table: table.replace_schema_metadata(None))  # an older Punctura, pandas, ...
    with pytest.raises(StudyError, match=rf"{name} does not state its plan.*move this file away"):
        run_study(plan, out)
    (out / name).unlink()
    (out / name).write_bytes(b"no Parquet")
    (out / "study.json").unlink()
    with pytest.raises(StudyError, match=rf"{name} cannot be read, and study.json does not say.*move this file away"):
        run_study(plan, out)
    assert (out / name).read_bytes() == b"no Parquet"
    (out / name).rename(tmp_path / "away")
    assert run_study(plan, out).kept == (0 if name == "trials.parquet" else 4)


@pytest.mark.parametrize(
    "change",
    [
        lambda table: table.drop_columns(["peak"]),
        lambda table: table.append_column("mine", table["peak"]),
        lambda table: table.set_column(4, "peak", table["peak"].cast(pa.string())),
        lambda table: table.slice(1),
    ],
)
@pytest.mark.parametrize("name", [pytest.param("trials.parquet", marks=pytest.mark.statistics), "chunk-000001.parquet"])
def test_a_file_with_other_columns_or_rows_is_computed_again(
    tmp_path: Path, name: str, change: Callable[[pa.Table], pa.Table], monkeypatch: pytest.MonkeyPatch
) -> None:
    out, plan = tmp_path / "out", load_plan(written(tmp_path, GRID))
    run_study(plan, tmp_path / "whole")
    in_chunks(plan, out, monkeypatch)
    if name == "trials.parquet":
        run_study(plan, out)
    changed(out / name, change)
    with pytest.warns(StudyWarning, match=rf"{name} is damaged or was changed: its trials are computed again"):
        run_study(plan, out)
    assert pq.read_table(out / "trials.parquet").equals(pq.read_table(tmp_path / "whole" / "trials.parquet"))


def test_a_row_again_takes_the_place_of_the_same_row_only(tmp_path: Path) -> None:
    out = tmp_path / "rows"
    _, mine = replay_row(load_plan(written(tmp_path, GRID)), 4, out)
    before = mine.read_bytes()
    with pytest.raises(StudyError, match=r"row-4\.parquet is no recording of this row of this plan"):
        replay_row(load_plan(written(tmp_path, OTHER)), 4, out)
    assert mine.read_bytes() == before
    replay_row(load_plan(written(tmp_path, GRID)), 4, out)
    assert mine.read_bytes() != before  # it states when it was made
    mine.write_bytes(b"a file of the user")
    with pytest.raises(StudyError, match=r"row-4\.parquet is no recording"):
        replay_row(load_plan(written(tmp_path, GRID)), 4, out)
