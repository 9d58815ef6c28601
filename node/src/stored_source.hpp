#pragma once

#include <memory>
#include <vector>

#include "burin/node/brick_source.hpp"
#include "stored_reader.hpp"

namespace burin::node {

/// Data units = stored * slope + intercept.
struct Rescale {
  double slope = 1;
  double intercept = 0;
  friend bool operator==(const Rescale&, const Rescale&) = default;
};

/// What is made of stored voxels on their way to a brick.
struct Conversion {
  int component = 0;
  std::vector<Rescale> rescale{{}};  ///< one for all slices, or one per slice
  /// The smallest and largest number that can be stored, where the file says less than its type.
  std::optional<glm::dvec2> storedRange;
};

/// One component of a file's voxels in data units. The type is the one they are stored in, if it
/// can be delivered and nothing is rescaled; a 16-bit one if it is shifted by a whole number and
/// still fits; else f32 (computed in double). What is lost by that stands in the notice.
class StoredSource : public BrickSource {
 public:
  /// `info.name` and `info.grid` count, the rest is set. `encoding`: how `info` calls it.
  StoredSource(VolumeInfo info, std::unique_ptr<StoredReader> stored, Conversion conversion,
               std::string_view encoding);
  const VolumeInfo& info() const override { return info_; }
  bool randomAccess() const override { return stored_->randomAccess(); }
  void load(const IndexBox& region, std::span<std::byte> out) override;

 private:
  void convert(const Rescale& rescale, std::span<std::byte> out) const;

  std::unique_ptr<StoredReader> stored_;
  Conversion conversion_;
  VolumeInfo info_;
  std::vector<std::byte> scratch_;
};

/// The component that the user chose. Throws Error{kVolume} if there are several and none was
/// chosen, Error{kUsage} if there is none of that number.
int chosenComponent(const VolumeChoice& choice, int components);

}  // namespace burin::node
