# The slow, double-precision truth that the GL renderer is compared with.
burin_library(reference
  SOURCES src/reference.cpp src/reference_cut.cpp src/reference_gradient_scale.cpp src/reference_halo.cpp src/reference_hit.cpp src/reference_laplacian.cpp src/reference_layer.cpp src/reference_tone.cpp src/reference_mean_class.cpp src/reference_widgets.cpp
          src/reference_pieces.cpp src/reference_projection.cpp src/reference_ray.cpp src/reference_labels.cpp src/reference_volume.cpp
  PUBLIC burin::scene burin::volumes
  PRIVATE Threads::Threads)
burin_unity(burin_reference)
