#pragma once

#include <span>
#include <vector>

#include "burin/common/scene.hpp"
#include "gl.hpp"
#include "transfer_table.hpp"
#include "value_scale.hpp"

namespace burin::node {

/// Texture units of one transfer function: its table's rows; the extinction's, of which nearest
/// texels are read.
inline constexpr GLuint kUnitsPerFunction = 2;

/// A scene's transfer functions as tables and as the textures that programs look them up in. Its
/// OffscreenContext must be current.
class TransferTextures {
 public:
  /// Follows the scene; does nothing if its transfer functions stand. If it throws, the ones before
  /// stay.
  void set(const Scene& scene, const ValueScale& scale);

  std::span<const TransferTable> tables() const { return tables_; }
  /// Of the tables and of their textures.
  std::size_t bytes() const;
  /// Binds the textures of transfer function i to the units from firstUnit + i * kUnitsPerFunction
  /// on.
  void bind(GLuint firstUnit) const;

 private:
  std::vector<TransferFunction> functions_;
  bool preintegrated_ = false;
  std::vector<TransferTable> tables_;
  std::vector<Texture> textures_;  ///< kUnitsPerFunction of each; the second may be none
};

}  // namespace burin::node
