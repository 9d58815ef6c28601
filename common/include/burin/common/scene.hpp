#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "burin/common/annotations.hpp"
#include "burin/common/camera.hpp"
#include "burin/common/gradient_operator.hpp"
#include "burin/common/layer_mode.hpp"
#include "burin/common/style.hpp"
#include "burin/common/transfer_function.hpp"

namespace burin {

/// Largest side of a picture, in pixels; llvmpipe's largest target.
inline constexpr int kLargestImageSide = 16384;
/// Largest step that is chosen for quality.max_error; smaller ones are halves of it.
inline constexpr double kLargestChosenStep = 4;
/// Smallest distance of sample planes, in multiples of the smallest spacing.
inline constexpr double kSmallestStepVoxels = 1e-3;
/// Most sample planes across a volume: single precision tells them and their middles apart.
inline constexpr double kMostPlanes = 0x1p22;
/// Most points of a curve; each is code in the ray-cast program.
inline constexpr std::size_t kMostCurvePoints = 64;
/// Largest number of lights, of layers and of clip planes and boxes.
inline constexpr int kMostListed = 16;

/// Where the voxels come from: a file, or a procedural kind with its dims. The raw* keys are needed
/// only for bare raw files whose name does not say them. A scene without a volume (both empty) is a
/// look waiting for one.
struct VolumeChoice {
  std::string file;        ///< as written; relative to the scene file
  std::string procedural;  ///< e.g. "vessels"; at most one of the two is set
  std::optional<glm::ivec3> dims;
  std::optional<std::string> type;    ///< "u8", "i16", "u16", "f32"; of a raw file also wider ones
  std::optional<std::string> endian;  ///< "little", "big"
  std::optional<glm::dvec3> spacing;
  std::optional<int> component;       ///< of voxels that have several, 0 is the first
  std::optional<std::string> series;  ///< of a DICOM folder: its UID, or its number from 1 on
  friend bool operator==(const VolumeChoice&, const VolumeChoice&) = default;
};

/// A segmentation of the volume, on the same grid. A scene without one has neither file nor
/// procedural.
struct LabelVolumeChoice : VolumeChoice {
  std::string names;  ///< file of ITK-SNAP's label descriptions, as written; "": none
  bool isGiven() const { return !file.empty() || !procedural.empty(); }
  friend bool operator==(const LabelVolumeChoice&, const LabelVolumeChoice&) = default;
};

/// A label's number, or its name until resolveLabels() has found the number.
using LabelName = std::variant<int, std::string>;

/// As written in the scene: either orbit angles (or a named view), or eye / target / up.
struct CameraChoice {
  double azimuthDeg = 30;
  double elevationDeg = 20;
  std::optional<std::string> view;     ///< anterior posterior left right superior inferior
  std::optional<glm::dvec3> eye;       ///< world; then target and up count, the angles do not
  std::optional<glm::dvec3> target;    ///< with eye only; unset: the volume's centre
  std::optional<glm::dvec3> upVector;  ///< with eye only; unset: upAxis
  std::string upAxis = "auto";         ///< "auto", "y", "z"
  double verticalFovDeg = 30;
  double zoom = 1;
  Projection projection = Projection::kPerspective;
  friend bool operator==(const CameraChoice&, const CameraChoice&) = default;
};

struct Light {
  glm::dvec3 direction{0.3, 0.4, 0.86};  ///< points TO the light; need not be unit
  bool eyeSpace = true;                  ///< eye space: x right, y up, z to the viewer; else world
  Colour colour{255, 255, 255};
  double intensity = 1;
  friend bool operator==(const Light&, const Light&) = default;
};

struct OpacityPoint {
  double value = 0;    ///< data units
  double opacity = 0;  ///< in [0, 1], per opacity unit length
  friend bool operator==(const OpacityPoint&, const OpacityPoint&) = default;
};

struct Layer {
  std::string name;
  TransferFunction transferFunction;
  /// Pass II's own opacity by value, as the transfer function's; none: the transfer function's.
  std::vector<OpacityPoint> lineOpacity = {};
  std::vector<StyleSettings> styles;  ///< in the order of styleTable(), each at most once
  /// The layer is only where the label volume has one of these; none: it is everywhere.
  std::vector<LabelName> labels = {};
  LayerMode mode = LayerMode::kDvr;
  std::optional<double> isoValue = std::nullopt;  ///< data units; set in mode kIso, and there alone
  /// Of the surface wherever a ray meets it; its colour is the transfer function's at isoValue.
  double isoOpacity = 1;

  /// nullptr when the layer does not use that style.
  const StyleSettings* style(std::string_view styleName) const;
  /// Whether any style works on lines.
  bool hasLines() const;
  /// Opacity of the lines on a surface: lineOpacity at isoValue; isoOpacity if there is none.
  double isoLineOpacity() const;
  friend bool operator==(const Layer&, const Layer&) = default;
};

/// Keeps a·x + d >= 0, world units; need not be normalised.
struct ClipPlane {
  glm::dvec3 normal{1, 0, 0};
  double offset = 0;
  bool hasCap = true;  ///< light and tone see the plane where it cuts material (kCapVoxels)
  friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

/// Keeps min <= x <= max along every world axis.
struct ClipBox {
  glm::dvec3 min{0};
  glm::dvec3 max{1};
  bool hasCap = true;
  friend bool operator==(const ClipBox&, const ClipBox&) = default;
};

/// How several contributions to one sample (layers, and lines on what they lie on) become one.
enum class Combine {
  kSum,   ///< simultaneous media: extinctions add up, lines replace colour
  kOver,  ///< one drawn over the other, as Lum & Ma did; changes with the step
};

/// What a voxel's gradient direction is.
enum class Normals {
  kExact,
  kQuantised,  ///< the nearest of 240 directions, as 8 bits for one leave room for
};

/// When what values and gradients look like is looked up.
enum class Palettes {
  kAfter,   ///< after filtering: of the values and gradients at a sample
  kBefore,  ///< of voxels, as paletted textures do; what is found is filtered
};

struct Quality {
  double stepVoxels = 0.5;
  double termination = 0.002;  ///< rays end when transmittance < termination; 0: never
  /// A segment's colour and extinction are means over the values between its ends, not those of its
  /// middle.
  bool preintegrated = true;
  /// Largest difference (premultiplied linear RGBA) to the converged picture that is asked for: the
  /// renderer then samples as finely as that takes, and rays end at a sixteenth of it.
  std::optional<double> maxError;
  Combine combine = Combine::kSum;
  Normals normals = Normals::kExact;
  Palettes palettes = Palettes::kAfter;
  friend bool operator==(const Quality&, const Quality&) = default;
};

struct Scene {
  VolumeChoice volume;
  LabelVolumeChoice labels;
  CameraChoice camera;
  ImageSize imageSize{1024, 1024};
  std::optional<Colour> background = Colour{255, 255, 255};  ///< unset: transparent
  std::vector<Light> lights = std::vector<Light>(1);  ///< g++ 12 warns falsely of a braced Light{}
  std::vector<Layer> layers;
  std::vector<ClipPlane> clip;
  std::optional<ClipBox> clipBox;
  Quality quality;
  Annotations annotations;
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// Parses and validates scene text (JSON, comments allowed). `name` is how messages call it.
/// `overrides`: "layers.0.style.tone.strength=0.5"; applied to the JSON before validation; the
/// value is JSON, or a bare word taken as a string; null removes the key. Named styles and
/// colour maps are read from files (styleFolders(), or `name`'s folder). Throws Error{kUsage}:
/// "name:line:column: path: …", or "--set …: path: …" for what an override brought.
Scene parseScene(std::string_view text, std::string_view name,
                 const std::vector<std::string>& overrides = {});

/// The scene as JSON; parseScene(writeScene(s)) == s exactly for every scene that parseScene can
/// return. What the scene cannot say is not written: angles beside a view or an eye. Named styles
/// are written with all their parameters, so the text means the same wherever it is read.
std::string writeScene(const Scene& scene);

/// Makes the relative names of files in a scene, which are relative to `folder`, relative to where
/// that folder is seen from; absolute ones stay.
void setSceneFolder(Scene& scene, const std::filesystem::path& folder);

/// Reads a scene file; relative names of files are made relative to the file's folder.
Scene loadScene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// Facts of the volume that a scene refers to.
struct VolumeFacts {
  VolumeGrid grid;
  bool anatomical = false;  ///< world is LPS
};

/// Fills what depends on the volume: opacity unit lengths. Idempotent. Throws Error{kUsage} if the
/// step puts kMostPlanes planes or more into the volume.
void resolveScene(Scene& scene, const VolumeFacts& volume);

/// The camera in world space. `extraAzimuthDeg` is added to the azimuth (--orbit), or turns an
/// explicit eye about the target.
Camera resolveCamera(const Scene& scene, const VolumeFacts& volume, double extraAzimuthDeg = 0);

/// All planes that cut: the scene's, then the faces of its clip box.
std::vector<ClipPlane> clipPlanes(const Scene& scene);

/// World distance from a plane up to which what it cuts is shaded as the plane, in smallest
/// spacings; up to twice that the material's own gradient takes over. A fixed length, so that the
/// cut surface looks the same at every step.
inline constexpr double kCapVoxels = 1;

/// Unit world direction to the light.
glm::dvec3 lightDirectionWorld(const Light& light, const Camera& camera);

/// Is the transfer function of any layer two-dimensional?
bool hasWidgets(const Scene& scene);

/// Largest ghost width that any layer's styles declare, two-dimensional transfer functions take or
/// that the ends of pre-integrated segments need; 0 if nothing looks beyond a brick's own cells.
int ghostLayersNeeded(const Scene& scene);
/// Voxels from a segment's middle to its ends, at most, along any axis: 0 if only the middle
/// counts.
double segmentReachVoxels(const Scene& scene);
/// Whether any layer is bound to labels.
bool labelsNeeded(const Scene& scene);
/// What a scene looks up by value along a ray: the transfer function of each layer that is a
/// medium (the envelope of a two-dimensional one), followed by that of its lines (black) if it has
/// line opacities.
std::vector<TransferFunction> transferFunctions(const Scene& scene);
/// The operator that a layer's gradients are made with, whether any of its styles needs them or
/// not.
GradientOperator gradientOperator(const Layer& layer);
/// Those of the layers that need gradients: for styles or a two-dimensional transfer function.
GradientOperatorSet gradientOperatorsNeeded(const Scene& scene);
/// Whether any layer needs gradients.
bool gradientNeeded(const Scene& scene);
/// Whether any layer needs the smoothed Laplacian.
bool laplacianNeeded(const Scene& scene);

/// What the halos of a layer look at, around a place: the neighbours' distance, and that of their
/// neighbours, of which their gradients are made. In smallest spacings.
struct HaloNeighbourhood {
  double radius = 0;
  double aside = 0;
};
/// `halo`: settings of that style.
HaloNeighbourhood haloNeighbourhood(const StyleSettings& halo);
/// Whether a layer can have halos: they lie around a medium of values alone, which is no surface,
/// not bound to labels and not found by its gradients.
bool canHaveHalo(const Layer& layer);
/// How far beyond what its transfer functions show the halos of a scene may show, in smallest
/// spacings; 0 without halos.
double haloReach(const Scene& scene);
/// Whether any layer is a surface.
bool hasSurfaces(const Scene& scene);
/// Whether any layer is a projection.
bool hasProjections(const Scene& scene);
/// The scene in parts that are drawn by themselves, each an image, in list order: neighbouring
/// media and surfaces together, as they share the space they are in; every projection alone. Later
/// images lie over earlier ones.
std::vector<Scene> layerGroups(const Scene& scene);
/// Of each projection of which anything may show the value from which on values of the volume
/// matter to it, data units: -infinity if all do.
std::vector<double> projectedFrom(const Scene& scene);
/// The iso-values of the layers that are surfaces and of which, lines included, anything shows.
std::vector<double> shownSurfaces(const Scene& scene);

/// JSON Schema (draft 2020-12) of the scene file: the text of configs/schema.json.
std::string sceneSchemaJson();

}  // namespace burin
