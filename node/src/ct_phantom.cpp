#include "ct_phantom.hpp"

#include <cmath>

#include "smooth.hpp"

namespace burin::node {
namespace {

/// Radiodensities in Hounsfield units, rounded from clinical tables.
constexpr double kAir = -1000;
constexpr double kFat = -90;
constexpr double kSkin = 50;
constexpr double kMuscle = 60;
constexpr double kBone = 1100;
constexpr double kTooth = 1700;
constexpr double kBrain = 35;
constexpr double kFluid = 5;
constexpr double kLens = 90;
constexpr double kLesion = 180;

constexpr double kBlur = 0.006;  ///< half the width of a border, in cube units

struct Ellipsoid {
  glm::dvec3 centre;
  glm::dvec3 radii;

  /// Distance outside the surface, exact for a sphere, first order near the surface otherwise.
  double distance(const glm::dvec3& p) const {
    const glm::dvec3 q = (p - centre) / radii;
    const double scaled = glm::length(q);
    const double slope = glm::length(q / radii);
    // In the very middle the quotient is 0/0; there any distance well inside is right.
    if (slope < 1e-9) return -std::min(radii.x, std::min(radii.y, radii.z));
    return scaled * (scaled - 1) / slope;
  }
};

/// Distance outside a capsule from a to b.
double capsuleDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                       double radius) {
  const glm::dvec3 axis = b - a;
  const double t = glm::clamp(glm::dot(p - a, axis) / glm::dot(axis, axis), 0.0, 1.0);
  return glm::distance(p, a + t * axis) - radius;
}

/// 1 inside, 0 outside, smooth across the border.
double inside(double distance) {
  return 1 - smoothRamp(-kBlur, kBlur, distance);
}

/// Union of two distances with a rounded seam of width k.
double blend(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * h * k / 6;
}

/// Puts `material` where `amount` is 1.
void fill(double& value, double material, double amount) {
  value += (material - value) * amount;
}

/// The head is symmetric: sides are told by |x - 1/2|.
glm::dvec3 mirrored(const glm::dvec3& p) {
  return {0.5 + std::abs(p.x - 0.5), p.y, p.z};
}

constexpr Ellipsoid kCranium{{0.5, 0.60, 0.48}, {0.31, 0.335, 0.39}};
constexpr Ellipsoid kFace{{0.5, 0.42, 0.65}, {0.215, 0.23, 0.235}};
constexpr Ellipsoid kChin{{0.5, 0.255, 0.66}, {0.17, 0.12, 0.18}};
constexpr Ellipsoid kNose{{0.5, 0.43, 0.885}, {0.036, 0.072, 0.062}};
constexpr Ellipsoid kLips{{0.5, 0.315, 0.845}, {0.065, 0.030, 0.035}};
constexpr Ellipsoid kEar{{0.815, 0.47, 0.46}, {0.024, 0.085, 0.055}};
constexpr Ellipsoid kEye{{0.605, 0.50, 0.795}, {0.044, 0.044, 0.044}};
constexpr Ellipsoid kEyelid{{0.605, 0.50, 0.795}, {0.056, 0.050, 0.058}};

double skinDistance(const glm::dvec3& p, const glm::dvec3& m) {
  const double neck = capsuleDistance(p, {0.5, -0.1, 0.40}, {0.5, 0.30, 0.44}, 0.165);
  double skin = blend(kCranium.distance(p), kFace.distance(p), 0.08);
  skin = blend(skin, kChin.distance(p), 0.08);
  skin = blend(skin, neck, 0.10);
  skin = blend(skin, kNose.distance(p), 0.05);
  skin = blend(skin, kLips.distance(p), 0.03);
  skin = blend(skin, kEyelid.distance(m), 0.03);
  return blend(skin, kEar.distance(m), 0.03);
}

/// Distance outside the bones of the face: upper jaw, cheeks and lower jaw, with the orbits and the
/// nose cut out.
double faceBoneDistance(const glm::dvec3& p, const glm::dvec3& m) {
  const Ellipsoid face{{0.5, 0.43, 0.68}, {0.165, 0.155, 0.175}};
  const Ellipsoid mouth{{0.5, 0.30, 0.63}, {0.115, 0.090, 0.150}};
  const Ellipsoid orbit{{0.605, 0.50, 0.80}, {0.066, 0.058, 0.110}};
  const Ellipsoid nose{{0.5, 0.42, 0.83}, {0.036, 0.060, 0.120}};
  const double jaw =
      blend(capsuleDistance(m, {0.5, 0.21, 0.775}, {0.62, 0.235, 0.62}, 0.030),
            capsuleDistance(m, {0.62, 0.235, 0.62}, {0.675, 0.43, 0.53}, 0.026), 0.02);
  const double cheek = capsuleDistance(m, {0.60, 0.43, 0.76}, {0.71, 0.46, 0.56}, 0.020);
  double bone = blend(face.distance(p), cheek, 0.03);
  bone = std::max(bone, -mouth.distance(p));
  bone = std::min(bone, jaw);
  bone = std::max(bone, -orbit.distance(m));
  return std::max(bone, -nose.distance(p));
}

/// Teeth: an arch of alternating density between the jaws.
double toothAmount(const glm::dvec3& p) {
  if (p.z < 0.66) return 0;
  const double across = std::hypot(p.x - 0.5, p.z - 0.68) - 0.110;
  const double along = std::atan2(p.x - 0.5, p.z - 0.68);
  const double row = std::hypot(across, std::abs(p.y - 0.285) - 0.020) - 0.019;
  return inside(row) * smoothRamp(0.66, 0.70, p.z) * (0.6 + 0.4 * std::cos(26 * along));
}

/// What lies outside the brain case: face, jaws with teeth, eyes, spine. `depth`: how far below the
/// skin p lies; bone stays under it.
void addFace(double& value, const glm::dvec3& p, const glm::dvec3& m, double depth) {
  constexpr double kCover = 0.020;
  const Ellipsoid throat{{0.5, 0.36, 0.62}, {0.035, 0.10, 0.09}};
  const Ellipsoid lens{{0.605, 0.50, 0.826}, {0.018, 0.018, 0.009}};
  fill(value, kAir, inside(throat.distance(p)));
  const double bone = std::max(faceBoneDistance(p, m), kCover - depth);
  fill(value, kBone * 0.85, inside(bone));
  fill(value, kTooth, toothAmount(p) * inside(kCover / 2 - depth));
  fill(value, kFluid + 10, inside(kEye.distance(m)));
  fill(value, kLens, inside(lens.distance(m)));
  const double spine = capsuleDistance(p, {0.5, -0.1, 0.36}, {0.5, 0.28, 0.40}, 0.055);
  fill(value, kBone * (0.8 + 0.2 * std::cos(60 * p.y)), inside(spine));
}

constexpr Ellipsoid kBrainCase{{0.5, 0.615, 0.47}, {0.272, 0.298, 0.350}};

constexpr Ellipsoid kInnerCase{kBrainCase.centre, {0.245, 0.270, 0.322}};
constexpr Ellipsoid kSmoothBrain{kBrainCase.centre, {0.236, 0.260, 0.312}};
constexpr Ellipsoid kLesionShape{{0.37, 0.70, 0.55}, {0.045, 0.040, 0.045}};

/// Distance outside the brain: folds of the surface and the cleft between the halves are gentle
/// waves of the distance.
double brainDistance(const glm::dvec3& p) {
  const glm::dvec3 wave = glm::sin(p * glm::dvec3{58, 50, 54});
  const double cleft =
      0.020 * std::exp(-(p.x - 0.5) * (p.x - 0.5) * 4000) * smoothRamp(0.60, 0.75, p.y);
  const double folds = 0.007 * wave.x * wave.y * wave.z + 0.007 * std::abs(wave.x * wave.y);
  return kSmoothBrain.distance(p) + folds + cleft;
}

/// Distance outside the ventricles.
double hornDistance(const glm::dvec3& m) {
  return blend(capsuleDistance(m, {0.535, 0.66, 0.58}, {0.545, 0.68, 0.42}, 0.022),
               capsuleDistance(m, {0.545, 0.68, 0.42}, {0.60, 0.58, 0.38}, 0.018), 0.02);
}

/// What lies inside the brain case.
void addBrain(double& value, const glm::dvec3& p, const glm::dvec3& m) {
  const double inCase = inside(kInnerCase.distance(p));
  if (inCase == 0) return;
  fill(value, kFluid, inCase);
  fill(value, kBrain, inside(brainDistance(p)));
  fill(value, kFluid, inside(hornDistance(m)));
  fill(value, kLesion, inside(kLesionShape.distance(p)));
}

/// What lies outside the brain case: air, skin, fat, muscle, the face.
double outerTissue(const glm::dvec3& p, const glm::dvec3& m) {
  const double skin = skinDistance(p, m);
  if (skin >= kBlur) return kAir;
  double value = kAir;
  fill(value, kSkin, inside(skin));
  fill(value, kFat, inside(skin + 0.014));
  fill(value, kMuscle, inside(skin + 0.028) * 0.9);
  addFace(value, p, m, -skin);
  return value;
}

}  // namespace

double ctPhantomHounsfield(const glm::dvec3& p) {
  const glm::dvec3 m = mirrored(p);
  // Bone covers all of the outer tissue well inside the case, which is a third of the head: there
  // it need not be evaluated.
  const double bone = inside(kBrainCase.distance(p));
  double value = bone < 1 ? outerTissue(p, m) : kAir;
  if (bone > 0) {
    fill(value, kBone, bone);
    addBrain(value, p, m);
  }
  return value;
}

int ctPhantomLabel(const glm::dvec3& p) {
  const glm::dvec3 m = mirrored(p);
  if (kInnerCase.distance(p) < 0) {
    if (kLesionShape.distance(p) < 0) return 5;
    if (hornDistance(m) < 0) return 4;
    return brainDistance(p) < 0 ? 3 : 0;
  }
  if (kBrainCase.distance(p) < 0) return 2;
  if (kEye.distance(m) < 0) return 6;
  // Else by what the tissue looks like: bone is what is denser than anything soft.
  const double value = ctPhantomHounsfield(p);
  if (value < -500) return 0;
  return value > 400 ? 2 : 1;
}

}  // namespace burin::node
