"""An FMU has the variables of its scene, and its binary gives the forces of the core."""

import re
import zipfile
from xml.etree import ElementTree

import numpy as np
import punctura as pn
import pytest
from fmu_slave import INPUTS, SCENE, Slave
from punctura.fmu import export_fmu
from punctura.fmu.description import base_units, variables


def names_of(version, tree):
    listed = tree.find("ModelVariables")
    return {variable.get("name"): variable for variable in listed}


@pytest.mark.parametrize("version", [2, 3])
def test_the_description_has_every_variable_of_the_scene_with_its_value_and_unit(tmp_path, version):
    file = export_fmu(SCENE, tmp_path / "a needle.fmu", version=version)
    scene = pn.load_scene(SCENE)
    with zipfile.ZipFile(file) as archive:
        tree = ElementTree.fromstring(archive.read("modelDescription.xml"))
        names = archive.namelist()
    assert tree.get("fmiVersion") == f"{version}.0"
    identifier = tree.find("CoSimulation").get("modelIdentifier")
    assert identifier == "a_needle"
    assert any(re.fullmatch(rf"binaries/[^/]+/{identifier}\.(so|dylib|dll)", name) for name in names)
    listed = names_of(version, tree)
    references = [variable.get("valueReference") for variable in listed.values()]
    assert len(set(references)) == len(references)
    units = {unit.get("name") for unit in tree.find("UnitDefinitions")}
    for field in scene.fields():
        if field.path.startswith("display"):
            continue
        variable = listed[field.path]
        start = variable if version == 3 else variable[0]
        assert float(start.get("start")) == field.value
        assert start.get("unit", "-") == field.unit and (field.unit == "-" or field.unit in units)


def test_the_binary_gives_the_forces_of_the_core(tmp_path):
    scene = pn.load_scene(SCENE)
    needle = Slave(tmp_path).started()
    axis = np.array([0.1, -1.0, 0.0])
    positions = np.linspace(-1e-3, 9e-3, 400)[:, None] * axis
    forces = np.empty((400, 3))
    for k, p in enumerate(positions):
        assert needle.set(INPUTS, (*p, *axis)) == 0
        assert needle.step(k / scene.servo.rate, 1 / scene.servo.rate) == 0
        forces[k] = needle.force()
    assert np.array_equal(forces, pn.Insertion(scene).run(positions, axis).force)
    assert np.abs(forces).max() > 0.5


def test_the_verb_writes_an_fmu_and_says_what_is_wrong(tmp_path, punctura):
    file = tmp_path / "x.fmu"
    done = punctura("export-fmu", SCENE, "-o", file, "--fmi", "2")
    assert done.status == 0 and file.is_file() and "FMI 2.0" in done.stdout
    done = punctura("export-fmu", SCENE, "-o", tmp_path / "x.zip")
    assert done.status == 2 and "x.zip: must end in .fmu" in done.stderr


def test_the_same_scene_gives_the_same_file(tmp_path):
    a, b = (export_fmu(SCENE, tmp_path / folder / "n.fmu").read_bytes() for folder in made_folders(tmp_path))
    assert a == b


def made_folders(folder):
    for name in ("a", "b"):
        (folder / name).mkdir()
        yield name


@pytest.mark.parametrize("name", pn.scene_names())
def test_every_unit_of_a_ready_scene_is_known(name):
    assert all(base_units(variable.unit) for variable in variables(pn.load_scene(name)) if variable.unit)
    assert base_units("Pa s/m^3") == {"kg": 1, "m": -4, "s": -1}
