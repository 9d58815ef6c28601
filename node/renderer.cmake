# burin::node: OpenGL off-screen, the fused ray-cast program, bricks and the Worker.
find_program(BURIN_GLAD glad REQUIRED)
find_package(Python3 REQUIRED COMPONENTS Interpreter)

set(glad_dir ${CMAKE_CURRENT_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h
  COMMAND ${BURIN_GLAD} --quiet --reproducible --api gl:core=4.5 --extensions ""
          --out-path ${glad_dir} c --mx
  COMMENT "Generating the OpenGL loader" VERBATIM)
add_library(burin_gl_loader STATIC ${glad_dir}/src/gl.c)
target_include_directories(burin_gl_loader PUBLIC $<BUILD_INTERFACE:${glad_dir}/include>)

set(shader_files
  fullscreen.vert lattice.glsl ownership.glsl counters.glsl opacity.glsl volume.glsl neighbourhood.glsl
  direction_palette.glsl voxels.glsl palettes.glsl halo.glsl
  skip.glsl preintegration.glsl widgets.glsl sides.glsl shading.glsl caps.glsl position.glsl laplacian.glsl labels.glsl adaptive.glsl
  cells.glsl halving.glsl exact.glsl surfaces.glsl surface_march.glsl projection.glsl march.glsl raycast.glsl slice.glsl resolve.glsl
  styles/surface.glsl styles/boundary.glsl styles/silhouette.glsl styles/fade.glsl styles/light.glsl
  styles/tone.glsl styles/toon.glsl styles/depth.glsl styles/laplacian.glsl styles/halo.glsl styles/edges.glsl
  styles/specular.glsl styles/line_surface.glsl)
list(TRANSFORM shader_files PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/shaders/ OUTPUT_VARIABLE shader_paths)
set(embedded ${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp)
add_custom_command(
  OUTPUT ${embedded}
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${embedded} -DROOT=${CMAKE_CURRENT_SOURCE_DIR}/shaders
          "-DFILES=${shader_files}" -P ${CMAKE_CURRENT_SOURCE_DIR}/shaders/embed.cmake
  DEPENDS ${shader_paths} shaders/embed.cmake
  COMMENT "Embedding shaders" VERBATIM)

burin_library(node
  SOURCES src/gl.cpp src/osmesa_context.cpp src/egl_context.cpp src/offscreen_context.cpp
          src/thread_share.cpp src/shader_conditions.cpp src/shader_source.cpp
          src/gl_program.cpp src/program_needs.cpp src/uniform_names.cpp src/curve_code.cpp
          src/widget_code.cpp src/gradient_code.cpp src/style_code.cpp src/layer_code.cpp
          src/program_generator.cpp src/direction_palette.cpp
          src/transfer_integral.cpp src/transfer_table.cpp
          src/visible_values.cpp src/value_scale.cpp src/value_ranges.cpp src/clip_planes.cpp
          src/visible_blocks.cpp src/macrocell_ranges.cpp src/octant_plane.cpp src/macrocells.cpp src/dilated_marks.cpp src/chessboard_distance.cpp
          src/step_map.cpp src/brick_texture.cpp src/laplacian_texture.cpp src/label_masks.cpp src/label_texture.cpp
          src/visible_group.cpp src/brick.cpp src/cost_estimate.cpp
          src/extinction_means.cpp src/view_rays.cpp src/hiding.cpp src/drawing_cost.cpp
          src/balanced_tree.cpp
          src/program_uniforms.cpp src/transfer_textures.cpp src/sample_counters.cpp
          src/frame_target.cpp src/layer_images.cpp src/brick_renderer.cpp src/raycaster.cpp
          src/slicer.cpp src/projector.cpp src/group_renderer.cpp src/group_image.cpp src/technique.cpp
          src/worker_needs.cpp src/brick_loading.cpp src/worker.cpp ${embedded}
  PUBLIC burin::volumes burin::compositor
  PRIVATE $<BUILD_INTERFACE:burin_gl_loader> ${CMAKE_DL_LIBS})
burin_unity(burin_node)
# Opens a library and makes a context, as osmesa_context.cpp does.
set_source_files_properties(src/egl_context.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
