#include "transfer_textures.hpp"

#include <algorithm>
#include <array>

namespace burin::node {
namespace {

void setLookUp(const Texture& texture, GLint filter) {
  gl().TextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl().TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, filter);
  gl().TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, filter);
  checkGl("uploading a transfer function");
}

/// Rows of equal length as the layers of an array texture.
Texture uploadRows(std::span<const std::span<const glm::vec4>> rows) {
  Texture texture = makeTexture(GL_TEXTURE_1D_ARRAY);
  const auto width = static_cast<GLsizei>(rows.front().size());
  gl().TextureStorage2D(texture.id(), 1, GL_RGBA32F, width, static_cast<GLsizei>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    gl().TextureSubImage2D(texture.id(), 0, 0, static_cast<GLint>(i), width, 1, GL_RGBA, GL_FLOAT,
                           rows[i].data());
  setLookUp(texture, GL_LINEAR);
  return texture;
}

Texture uploadEntries(std::span<const glm::vec4> entries) {
  Texture texture = makeTexture(GL_TEXTURE_1D);
  const auto width = static_cast<GLsizei>(entries.size());
  gl().TextureStorage1D(texture.id(), 1, GL_RGBA32F, width);
  gl().TextureSubImage1D(texture.id(), 0, 0, width, GL_RGBA, GL_FLOAT, entries.data());
  setLookUp(texture, GL_NEAREST);
  return texture;
}

std::array<Texture, kUnitsPerFunction> upload(const TransferTable& table, bool preintegrated) {
  const TransferRows rows = transferRows(table);
  const std::array<std::span<const glm::vec4>, 2> all{rows.table, rows.colour};
  return {uploadRows(std::span{all}.first(preintegrated ? 2 : 1)),
          preintegrated ? uploadEntries(rows.extinction) : Texture{}};
}

}  // namespace

void TransferTextures::set(const Scene& scene, const ValueScale& scale) {
  const bool preintegrated = scene.quality.preintegrated;
  std::vector<TransferFunction> functions = transferFunctions(scene);
  if (preintegrated_ == preintegrated && functions_ == functions) return;
  std::vector<TransferTable> tables;
  std::vector<Texture> textures;
  for (const TransferFunction& function : functions) {
    tables.push_back(makeTransferTable(function, function.opacityUnitLength.value(), scale.lowest,
                                       scale.highest));
    for (Texture& texture : upload(tables.back(), preintegrated))
      textures.push_back(std::move(texture));
  }
  functions_ = std::move(functions);
  preintegrated_ = preintegrated;
  tables_ = std::move(tables);
  textures_ = std::move(textures);
}

std::size_t TransferTextures::bytes() const {
  std::size_t sum = 0;
  for (const TransferTable& table : tables_) {
    const std::size_t texels = table.entries.size() + 1;
    sum += table.entries.size() * sizeof(glm::vec4) + table.means.size() * sizeof(glm::dvec4) +
           (preintegrated_ ? 3 : 1) * texels * sizeof(glm::vec4);
  }
  return sum;
}

void TransferTextures::bind(GLuint firstUnit) const {
  for (std::size_t i = 0; i < textures_.size(); ++i)
    gl().BindTextureUnit(firstUnit + static_cast<GLuint>(i), textures_[i].id());
}

}  // namespace burin::node
