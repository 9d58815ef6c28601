#include "camera_keys.hpp"

#include <variant>

namespace burin::scene_io {

namespace {

using Choice = CameraChoice;

/// "up" is an axis by name or, beside an eye, a vector.
using Up = std::variant<std::string, glm::dvec3>;

Codec<Up> upCodec() {
  const Codec<std::string> axis = word({"auto", "y", "z"});
  const Codec<glm::dvec3> vector = direction();
  return {[axis, vector](const At& at) -> Up {
            if (at.node.kind == Node::Kind::kList) return vector.read(at);
            return axis.read(at);
          },
          [axis, vector](const Up& up) {
            if (const auto* written = std::get_if<glm::dvec3>(&up)) return vector.write(*written);
            return axis.write(std::get<std::string>(up));
          },
          Document{{"anyOf", {axis.schema, vector.schema}}}};
}

Field<Choice> upField() {
  return field<Choice, Up>(
      "up",
      "World axis that is up (auto: z for anatomical volumes, else y); beside eye also a vector",
      upCodec(),
      [](const Choice& c) -> std::optional<Up> {
        if (c.view) return std::nullopt;
        if (c.upVector) return *c.upVector;
        return c.upAxis;
      },
      [](Choice& c, const Up& up) {
        if (const auto* vector = std::get_if<glm::dvec3>(&up)) {
          c.upVector = *vector;
        } else {
          c.upAxis = std::get<std::string>(up);
        }
      });
}

/// An orbit angle: not written where a view or an eye rules.
Field<Choice> angleField(std::string_view name, std::string_view help, double Choice::*angle,
                         Range range) {
  return field<Choice, double>(
      name, help, number(range),
      [angle](const Choice& c) { return c.view || c.eye ? std::nullopt : std::optional{c.*angle}; },
      [angle](Choice& c, double value) { c.*angle = value; });
}

Field<Choice> projectionField() {
  return field<Choice, std::string>(
      "projection", "How rays run", word({"perspective", "orthographic"}),
      [](const Choice& c) {
        const bool perspective = c.projection == Projection::kPerspective;
        return std::optional<std::string>{perspective ? "perspective" : "orthographic"};
      },
      [](Choice& c, const std::string& value) {
        c.projection =
            value == "perspective" ? Projection::kPerspective : Projection::kOrthographic;
      });
}

/// Refuses each of `keys` that is written beside `ruler`.
void exclude(const At& at, std::string_view ruler, std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) {
    if (const Node* found = at.node.find(key)) {
      At::failAt(found->where, json::childPath(at.path, key),
                 fmt::format("cannot stand beside '{}'", ruler));
    }
  }
}

void checkCamera(const At& at, const Choice& camera) {
  if (camera.view) exclude(at, "view", {"azimuth_deg", "elevation_deg", "eye", "target", "up"});
  if (camera.eye) {
    exclude(at, "eye", {"azimuth_deg", "elevation_deg"});
    if (camera.target && *camera.target == *camera.eye) at.fail("'target' equals 'eye'");
    return;
  }
  if (const Node* target = at.node.find("target")) {
    At::failAt(target->where, json::childPath(at.path, "target"), "needs 'eye' beside it");
  }
  if (camera.upVector) {
    At::failAt(at.node.find("up")->where, json::childPath(at.path, "up"),
               "a vector needs 'eye' beside it; expected 'auto', 'y' or 'z'");
  }
}

}  // namespace

Codec<CameraChoice> cameraCodec() {
  return object<Choice>(
      {angleField("azimuth_deg", "Orbit: degrees around the up axis, 0 in front",
                  &Choice::azimuthDeg, kAnyNumber),
       angleField("elevation_deg", "Orbit: degrees above the horizon", &Choice::elevationDeg,
                  {.minimum = -180, .maximum = 180}),
       field("view", "Instead of angles: an anatomical view (world is LPS, up is z)", &Choice::view,
             word({"anterior", "posterior", "left", "right", "superior", "inferior"})),
       field("eye", "Instead of angles: where the eye is, world units", &Choice::eye,
             vector3(kAnyNumber)),
       field("target", "Beside eye: where it looks, world units; default the volume's centre",
             &Choice::target, vector3(kAnyNumber)),
       upField(),
       field("vertical_fov_deg", "Field of view of the smaller image side, in degrees",
             &Choice::verticalFovDeg,
             number(
                 {.minimum = 0, .maximum = 180, .minimumExcluded = true, .maximumExcluded = true})),
       field("zoom", "Magnification of the picture; 1 shows the whole volume", &Choice::zoom,
             number(kPositive)),
       projectionField()},
      checkCamera);
}

}  // namespace burin::scene_io
