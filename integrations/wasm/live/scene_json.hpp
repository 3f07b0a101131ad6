// A scene and its laws as the page draws them: SceneView and LawCurve of python/punctura/studio/wire/common.py,
// without the tables of the file.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "json.hpp"
#include "punctura/lab/events/law_curve.hpp"
#include "punctura/scene/lumen.hpp"

namespace punctura::live {

/// angles: of the needle to each membrane's inward normal, rad.
inline void write_laws(Json& json, const Scene& scene, const std::vector<double>& angles) {
  json.open('[');
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const MembraneLaw law = membrane_law(scene, i, angles[i]);
    json.open('{').field("name", scene.membranes[i].name).field("obliquity", angles[i]);
    json.field("far_face", law.far_face).field("through", law.through);
    json.key("depth").all(law.curve.depth).key("lower").all(law.curve.lower).key("upper").all(law.curve.upper);
    json.close('}');
  }
  json.close(']');
}

/// number: index of the scene in this run. rate: of the run, Hz. force_scale: of the device.
inline void write_scene(Json& json, const Scene& scene, int number, double rate, double force_scale,
                        const std::vector<double>& angles) {
  json.open('{').field("number", number).field("name", scene.name).field("diameter", scene.needle.diameter);
  json.field("tip_length", tip_length(scene.needle));
  json.field("direction", word_of(scene.direction));
  json.field("solver", word_of(scene.servo.solver));
  json.field("rate", rate).field("force_scale", force_scale).key("membranes").open('[');
  for (const PlacedMembrane& placed : scene.membranes) {
    const Vector3d normal = to_vector(placed.inward_normal);
    json.open('{').field("name", placed.name).key("point").all(placed.point);
    json.key("inward_normal").all(normal / normal.norm()).field("thickness", placed.membrane.thickness);
    json.field("look", word_of(placed.look)).field("behind", word_of(placed.behind)).close('}');
  }
  json.close(']').key("laws");
  write_laws(json, scene, angles);
  json.key("lumen").open('[');
  if (const auto vessel = lumen(scene)) json.value(vessel->first).value(vessel->second);
  json.close(']').key("syringe");
  if (scene.syringe)
    json.open('{')
        .field("bore", scene.syringe->syringe.bore)
        .field("volume", scene.syringe->syringe.liquid + scene.syringe->syringe.air)
        .close('}');
  else
    json.null();
  json.close('}');
}

}  // namespace punctura::live
