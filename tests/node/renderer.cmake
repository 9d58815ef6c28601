# Drawing. A Worker is collective, so even programs for one rank run under MPI.
function(burin_add_renderer_test name)
  burin_add_mpi_test(${name} SOURCES ${name}.cpp
    LIBRARIES burin::node burin::reference burin_gl_loader LABELS node gl ${ARGN})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR}/node/src)
endfunction()

burin_add_renderer_test(brick_invariance_test RANKS 1 TIMEOUT 600)
burin_add_renderer_test(rank_invariance_test RANKS 1 2 3 4 5 8 TIMEOUT 300)
burin_add_renderer_test(skipping_test RANKS 1 TIMEOUT 600)
burin_add_renderer_test(slices_test RANKS 1 TIMEOUT 600)
target_sources(slices_test PRIVATE palettes_test.cpp halo_test.cpp)
burin_add_renderer_test(iso_surface_test RANKS 1 TIMEOUT 300)
target_sources(iso_surface_test PRIVATE projection_test.cpp)
burin_add_renderer_test(preintegration_test RANKS 1 TIMEOUT 300)
burin_add_renderer_test(scene_update_test RANKS 1 TIMEOUT 600)
burin_add_renderer_test(failing_update_test RANKS 1 3 TIMEOUT 300)
burin_add_renderer_test(against_reference_test RANKS 1 TIMEOUT 600)
burin_add_renderer_test(widgets_test RANKS 1 TIMEOUT 300)
burin_add_renderer_test(style_range_test RANKS 1 TIMEOUT 600)
burin_add_renderer_test(stability_test RANKS 1 TIMEOUT 600)
target_sources(stability_test PRIVATE stability_views_test.cpp)
burin_add_renderer_test(voxel_types_test RANKS 1 TIMEOUT 300)
target_compile_definitions(voxel_types_test PRIVATE
  BURIN_WRITE_VOLUMES="${CMAKE_CURRENT_SOURCE_DIR}/write_volumes.py")
burin_add_renderer_test(program_generator_test RANKS 1 TIMEOUT 300)
target_sources(program_generator_test PRIVATE shader_conditions_test.cpp)
burin_add_renderer_test(macrocells_test RANKS 1)
burin_add_renderer_test(clip_planes_test RANKS 1)
burin_add_renderer_test(visible_blocks_test RANKS 1)
burin_add_renderer_test(labels_test RANKS 1 TIMEOUT 300)
burin_add_renderer_test(brick_parts_test RANKS 1 TIMEOUT 300)
burin_add_renderer_test(transfer_table_test RANKS 1)
burin_add_renderer_test(cost_estimate_test RANKS 1 3)
burin_add_renderer_test(balanced_tree_test RANKS 1)
burin_add_renderer_test(gl_backends_test RANKS 1 TIMEOUT 300)

# What of it takes all ranks together.
burin_test_command(labels_test labels_test)
add_test(NAME labels_test_3 COMMAND ${BURIN_MPIRUN} -n 3 ${labels_test}
  --gtest_filter=*FailAllRanks:LabelSurvey.*)
burin_set_test(labels_test_3 TIMEOUT 120 PROCESSORS 2 LABELS node gl mpi)

# One scene on 13 ranks: an odd count far above the cores.
burin_test_command(rank_invariance_test rank_invariance_test)
add_test(NAME rank_invariance_test_13 COMMAND ${BURIN_MPIRUN} -n 13 ${rank_invariance_test}
  --gtest_filter=RankInvariance.MoreBricksThanRanks)
burin_set_test(rank_invariance_test_13 TIMEOUT 120 PROCESSORS 2 LABELS node gl mpi)
