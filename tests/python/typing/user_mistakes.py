"""What a user must not write: type checkers refuse each line that ends in `# wrong`, and no other."""

import punctura as pn
from punctura.exercise import ResultStore, load_exercise
from punctura.live import enumerate_devices, load_limits
from punctura.studio.activity import Activity

scene = pn.load_scene("k06-fig10")
law = pn.ThinLaw(scene.needle, scene.membranes[0].membrane)
pn.Proxy1d(law, scene.coupling, 1e-3, solver="exakt")  # wrong
pn.Needle(diametre=1e-3, tip_angle=0.28)  # wrong
scene.with_values({"membrane[0].friction": "0.3"})  # wrong
print(enumerate_devices()[0]["name"])  # wrong
load_limits("limits.toml").at_most("0.5")  # wrong
ResultStore("results").save(load_exercise("venipuncture"))  # wrong
activity: Activity = object()  # wrong
