"""Prints the venipuncture as the page gets it, for the page's tests: npm run types."""

from punctura.studio.loaded import from_name
from punctura.studio.view import scene_view

print(scene_view(from_name("venipuncture"), number=0, rate=1600.0, force_scale=1.0).model_dump_json())
