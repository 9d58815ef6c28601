#include "scene_keys.hpp"

#include "annotation_keys.hpp"
#include "burin/common/combine_name.hpp"
#include "burin/common/palette_names.hpp"
#include "camera_keys.hpp"
#include "layer_keys.hpp"

namespace burin::scene_io {

namespace {

constexpr std::size_t kMost = static_cast<std::size_t>(kMostListed);

/// Of the volume, or of the label volume beside it.
void checkVolume(const At& at, const VolumeChoice& volume) {
  if (volume.file.empty() == volume.procedural.empty()) {
    at.fail("expected exactly one of 'file' and 'procedural'");
  }
  if (volume.file.empty()) {
    if (!volume.dims) at.fail("'dims' is missing beside 'procedural'");
    forbid(at, "endian", "only a raw file has an endianness");
    forbid(at, "component", "only a file has several components");
    forbid(at, "series", "only a DICOM folder has several series");
  }
}

/// V: VolumeChoice, or what has more members.
template <typename V>
Fields<V> volumeFields() {
  const auto unlessEmpty = [](std::string V::*member) {
    return [member](const V& v) {
      return (v.*member).empty() ? std::nullopt : std::optional{v.*member};
    };
  };
  const auto keep = [](std::string V::*member) {
    return [member](V& v, std::string value) { v.*member = std::move(value); };
  };
  return {field<V, std::string>("file", "Volume file, relative to this file", text(),
                                unlessEmpty(&V::file), keep(&V::file)),
          field<V, std::string>("procedural",
                                "Built-in volume instead of a file: marschner-lobb, shells, "
                                "homogeneous, ramp, vessels, ct-phantom or ct-phantom-labels",
                                text(), unlessEmpty(&V::procedural), keep(&V::procedural)),
          field<V, glm::ivec3>(
              "dims", "Voxels along x, y and z: of a built-in volume, or of a bare raw file",
              &V::dims, wholeNumbers3({.minimum = 1, .maximum = 1e6})),
          field<V, std::string>(
              "type", "Voxel type: of a built-in volume, or of a bare raw file", &V::type,
              word({"u8", "i8", "u16", "i16", "u32", "i32", "u64", "i64", "f32", "f64"})),
          field<V, std::string>("endian", "Byte order of a bare raw file", &V::endian,
                                word({"little", "big"})),
          field<V, glm::dvec3>(
              "spacing", "Distance of voxels along x, y and z, of a built-in volume or a raw file",
              &V::spacing, vector3(kPositive)),
          field<V, int>("component", "Which component of voxels that have several; 0 is the first",
                        &V::component, wholeNumber({.minimum = 0, .maximum = 1e6})),
          field<V, std::string>(
              "series", "Which series of a DICOM folder: its UID, or its number in the list",
              &V::series, text())};
}

Codec<VolumeChoice> volumeCodec() {
  return object<VolumeChoice>(volumeFields<VolumeChoice>(), checkVolume);
}

/// An object as "volume" is, with the names; or the file alone.
Codec<LabelVolumeChoice> labelVolumeCodec() {
  using V = LabelVolumeChoice;
  Fields<V> fields = volumeFields<V>();
  fields.push_back(field<V, std::string>(
      "names", "File of ITK-SNAP's label descriptions, relative to this file", text(),
      [](const V& v) { return v.names.empty() ? std::nullopt : std::optional{v.names}; },
      [](V& v, std::string value) { v.names = std::move(value); }));
  Codec<V> codec = object<V>(std::move(fields), checkVolume);
  codec.read = [read = std::move(codec.read)](const At& at) {
    if (at.node.kind != Node::Kind::kText) return read(at);
    V choice;
    choice.file = at.node.text;
    if (choice.file.empty()) at.fail("expected the name of a file");
    return choice;
  };
  codec.schema = Document{{"anyOf", {text().schema, std::move(codec.schema)}}};
  return codec;
}

Codec<Light> lightCodec() {
  using L = Light;
  return object<L>(
      {field("direction", "Vector that points TO the light", &L::direction, direction()),
       field<L, std::string>(
           "space", "eye: x right, y up, z to the viewer; or world", word({"eye", "world"}),
           [](const L& l) { return std::optional<std::string>{l.eyeSpace ? "eye" : "world"}; },
           [](L& l, const std::string& value) { l.eyeSpace = value == "eye"; }),
       field("color", "Colour of the light (sRGB)", &L::colour, colour()),
       field("intensity", "Factor on the light's colour", &L::intensity,
             number({.minimum = 0, .maximum = 100}))});
}

/// An item of the list: one of the two.
struct ClipChoice {
  std::optional<ClipPlane> plane;
  std::optional<ClipBox> box;
  bool hasCap = true;
};

Codec<ClipBox> clipBoxCodec() {
  using B = ClipBox;
  return object<B>(
      {required(field("min", "Smallest x, y and z that stay", &B::min, vector3(kAnyNumber))),
       required(field("max", "Largest x, y and z that stay", &B::max, vector3(kAnyNumber)))},
      [](const At& at, const B& box) {
        if (!glm::all(glm::lessThan(box.min, box.max)))
          at.fail("'min' must be below 'max' along every axis");
      });
}

Codec<ClipChoice> clipCodec() {
  using C = ClipChoice;
  return object<C>(
      {field<C, glm::dvec4>(
           "plane", "[a, b, c, d]: keeps a·x + b·y + c·z + d ≥ 0, world units", clipPlaneVector(),
           [](const C& c) {
             return c.plane ? std::optional{glm::dvec4{c.plane->normal, c.plane->offset}}
                            : std::nullopt;
           },
           [](C& c, const glm::dvec4& value) {
             c.plane = ClipPlane{glm::dvec3{value}, value.w};
           }),
       field("box", "Keeps what is inside, world units", &C::box, clipBoxCodec()),
       field("cap", "Light and tone see the cut itself, a voxel deep, not the material's gradient",
             &C::hasCap, boolean())},
      [](const At& at, const C& choice) {
        if (choice.plane.has_value() == choice.box.has_value())
          at.fail("expected exactly one of 'plane' and 'box'");
      });
}

std::vector<ClipChoice> clipChoices(const Scene& scene) {
  std::vector<ClipChoice> choices;
  for (const ClipPlane& plane : scene.clip) choices.push_back({plane, {}, plane.hasCap});
  if (scene.clipBox) choices.push_back({{}, scene.clipBox, scene.clipBox->hasCap});
  return choices;
}

void setClip(Scene& scene, const std::vector<ClipChoice>& choices) {
  for (const ClipChoice& choice : choices) {
    if (choice.plane) {
      scene.clip.push_back(*choice.plane);
      scene.clip.back().hasCap = choice.hasCap;
    } else {
      scene.clipBox = choice.box;
      scene.clipBox->hasCap = choice.hasCap;
    }
  }
}

Codec<std::vector<ClipChoice>> clipListCodec() {
  Codec<std::vector<ClipChoice>> codec = list(clipCodec(), 0, kMost);
  codec.read = [read = std::move(codec.read)](const At& at) {
    std::vector<ClipChoice> choices = read(at);
    bool hasBox = false;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (hasBox && choices[i].box) at.item(i).fail("a second box; expected one at most");
      hasBox = hasBox || choices[i].box.has_value();
    }
    return choices;
  };
  return codec;
}

struct ImageChoice {
  ImageSize size;
  std::optional<Colour> background;
};

Codec<ImageChoice> imageCodec() {
  using I = ImageChoice;
  const Scene defaults;
  return object<I>(
      {field("size", "Width and height in pixels", &I::size, imageSize()),
       field<I, std::optional<Colour>>(
           "background", "Colour behind the volume (sRGB), or transparent", colourOrTransparent(),
           [](const I& i) { return std::make_optional(i.background); },
           [](I& i, const std::optional<Colour>& value) { i.background = value; })},
      {}, ImageChoice{defaults.imageSize, defaults.background});
}

/// A number of Quality that max_error chooses, and that is not written beside it.
Field<Quality> chosenByError(std::string_view name, std::string_view help, double Quality::*member,
                             Range range) {
  return field<Quality, double>(
      name, help, number(range),
      [member](const Quality& q) { return q.maxError ? std::nullopt : std::optional{q.*member}; },
      [member](Quality& q, double value) { q.*member = value; });
}

Codec<Quality> qualityCodec() {
  using Q = Quality;
  return object<Q>(
      {chosenByError("step_voxels", "Distance of samples, in smallest voxel spacings",
                     &Q::stepVoxels, {.minimum = kSmallestStepVoxels, .maximum = 100}),
       chosenByError("termination",
                     "Rays end when their transmittance falls below this; 0 is never",
                     &Q::termination, {.minimum = 0, .maximum = 0.5}),
       field("preintegrated",
             "Classify all values between the ends of a segment, not only that of its middle",
             &Q::preintegrated, boolean()),
       field("max_error",
             "Largest error asked for, of premultiplied linear colour; instead of step_voxels and "
             "termination",
             &Q::maxError, number({.minimum = 1e-4, .maximum = 0.5})),
       field<Q, std::string>(
           "combine",
           "How layers and lines at one sample become one: sum, or over, each drawn over the one "
           "before (slices only; depends on the step)",
           word({"sum", "over"}),
           [](const Q& q) { return std::optional<std::string>{name(q.combine)}; },
           [](Q& q, const std::string& value) {
             q.combine = value == "over" ? Combine::kOver : Combine::kSum;
           }),
       field<Q, std::string>(
           "normals",
           "Directions of gradients at voxels: exact, or quantised to the nearest of 240 (slices "
           "only)",
           word({"exact", "quantised"}),
           [](const Q& q) { return std::optional<std::string>{name(q.normals)}; },
           [](Q& q, const std::string& value) {
             q.normals = value == "quantised" ? Normals::kQuantised : Normals::kExact;
           }),
       field<Q, std::string>(
           "palettes",
           "Look up colours and styles after filtering, or before: of voxels, filtering what is "
           "found (slices only; without 'preintegrated')",
           word({"after", "before"}),
           [](const Q& q) { return std::optional<std::string>{name(q.palettes)}; },
           [](Q& q, const std::string& value) {
             q.palettes = value == "before" ? Palettes::kBefore : Palettes::kAfter;
           })},
      [](const At& at, const Q& quality) {
        if (quality.palettes == Palettes::kBefore && quality.preintegrated)
          at.fail(
              "'palettes' \"before\" classifies voxels, not what lies between values: expected "
              "'preintegrated' false");
        if (at.node.find("max_error") == nullptr) return;
        if (quality.combine == Combine::kOver)
          at.fail("'max_error' is the distance to what 'combine' \"sum\" converges to");
        if (quality.normals != Normals::kExact || quality.palettes != Palettes::kAfter)
          at.fail(
              "'max_error' is the distance to exact 'normals' and 'palettes' \"after\" filtering");
        for (const char* key : {"step_voxels", "termination"})
          if (at.node.find(key) != nullptr)
            at.fail("'max_error' chooses '{}' itself: give one of the two", key);
      });
}

void checkScene(const At& at, const Scene& scene) {
  if (scene.quality.maxError && hasProjections(scene))
    forbid({*at.node.find("quality"), "quality"}, "max_error",
           "layers of mode \"mip\" and \"average\" take samples of a step; expected 'step_voxels'");
}

constexpr double kVersion = 1;

Field<Scene> schemaVersionField() {
  Codec<double> version = number(kAnyNumber);
  version.schema = {{"const", 1}};
  version.read = [any = version.read](const At& at) {
    const double written = any(at);
    if (written != kVersion) at.fail("{} is unknown; this program reads {}", written, kVersion);
    return written;
  };
  return required(field<Scene, double>(
      "schema_version", "Version of this format", version,
      [](const Scene&) { return std::optional{kVersion}; }, [](Scene&, double) {}));
}

Codec<Scene> makeSceneCodec() {
  using S = Scene;
  return object<S>(
      {schemaVersionField(),
       field<S, VolumeChoice>(
           "volume", "Where the voxels come from", volumeCodec(),
           [](const S& s) {
             const bool none = s.volume.file.empty() && s.volume.procedural.empty();
             return none ? std::nullopt : std::optional{s.volume};
           },
           [](S& s, VolumeChoice value) { s.volume = std::move(value); }),
       field<S, LabelVolumeChoice>(
           "labels", "A segmentation on the volume's grid, which layers can be bound to; a file",
           labelVolumeCodec(),
           [](const S& s) { return s.labels.isGiven() ? std::optional{s.labels} : std::nullopt; },
           [](S& s, LabelVolumeChoice value) { s.labels = std::move(value); }),
       field("camera", "Orbit angles or a named view of the whole volume, or eye, target and up",
             &S::camera, cameraCodec()),
       field<S, ImageChoice>(
           "image", "The picture", imageCodec(),
           [](const S& s) {
             return std::optional{ImageChoice{s.imageSize, s.background}};
           },
           [](S& s, const ImageChoice& value) {
             s.imageSize = value.size;
             s.background = value.background;
           }),
       field("lights", "Directional lights; tone follows the first one", &S::lights,
             list(lightCodec(), 1, kMost)),
       required(field("layers",
                      "What is drawn, each with its own look: media and surfaces share space",
                      &S::layers, list(layerCodec(), 1, kMost))),
       field<S, std::vector<ClipChoice>>(
           "clip", "Planes, and one box at most, that cut material away", clipListCodec(),
           [](const S& s) { return std::optional{clipChoices(s)}; }, setClip),
       field("quality", "Accuracy against time", &S::quality, qualityCodec()),
       field<S, Annotations>(
           "annotations", "Title, scale bar, legend and axes over the picture (not in EXR)",
           annotationsCodec(),
           [](const S& s) {
             return s.annotations == Annotations{} ? std::nullopt : std::optional{s.annotations};
           },
           [](S& s, Annotations value) { s.annotations = std::move(value); })},
      checkScene);
}

}  // namespace

const Codec<Scene>& sceneCodec() {
  static const Codec<Scene> codec = makeSceneCodec();
  return codec;
}

}  // namespace burin::scene_io
