# The double-precision reference renderer, against closed forms.
burin_add_test(reference_test
  SOURCES reference_slab_test.cpp reference_convergence_test.cpp reference_invariance_test.cpp
          reference_converged_test.cpp reference_gradient_test.cpp reference_cut_test.cpp
          reference_laplacian_test.cpp reference_style_convergence_test.cpp
          reference_style_test.cpp
  LIBRARIES burin::reference
  LABELS node)
# How it reads voxels: the part of it for the sanitizers.
burin_add_test(reference_voxel_test SOURCES reference_voxel_test.cpp LIBRARIES burin::reference
  LABELS node sanitize)
# They have a kColour and a smoothField() of their own, as others do.
set_source_files_properties(reference_converged_test.cpp reference_style_convergence_test.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_include_directories(reference_test PRIVATE ${PROJECT_SOURCE_DIR}/node/src)
