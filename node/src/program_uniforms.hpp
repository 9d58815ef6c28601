#pragma once

#include <span>

#include "brick.hpp"
#include "burin/common/camera.hpp"
#include "burin/common/scene.hpp"
#include "burin/node/survey.hpp"
#include "gl_program.hpp"
#include "transfer_table.hpp"
#include "value_scale.hpp"

namespace burin::node {

/// What every program that draws a volume knows of it.
struct ProgramVolume {
  VolumeGrid grid;
  ValueScale scale;
  PerGradientOperator<GradientScales> gradients;
};

inline constexpr GLuint kVolumeUnit = 0;
inline constexpr GLuint kCellMapUnit = 1;
inline constexpr GLuint kFrameUnit = 2;
inline constexpr GLuint kLaplacianUnit = 3;
inline constexpr GLuint kLabelUnit = 4;
inline constexpr GLuint kFirstTransferUnit = 5;

// The uniforms of lattice.glsl, volume.glsl, skip.glsl, shading.glsl, ownership.glsl and of the
// generated layers, which all techniques share. Setting one that a program lacks does nothing.

/// What follows from the scene alone. `tables`: of the scene's transferFunctions(), whose textures
/// are bound as TransferTextures::bind(firstTransferUnit) does.
void setSceneUniforms(const GlProgram& program, const Scene& scene, const ProgramVolume& volume,
                      std::span<const TransferTable> tables, GLuint firstTransferUnit);
void setViewUniforms(const GlProgram& program, const Scene& scene, const Camera& camera,
                     const VolumeGrid& grid);
void setStepUniforms(const GlProgram& program, const Camera& camera, const VolumeGrid& grid,
                     double stepVoxels);
void setBrickUniforms(const GlProgram& program, const Scene& scene, const VolumeGrid& grid,
                      const Brick& brick);
/// To the units above.
void bindTextures(const Brick& brick);

}  // namespace burin::node
