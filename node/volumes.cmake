# Brick sources (files and procedural volumes), the volume writer, the survey.
burin_library(volumes
  SOURCES src/brick_source.cpp src/open_volume.cpp src/stored_voxels.cpp src/byte_order.cpp
          src/voxel_access.cpp src/file_handle.cpp src/gzip_stream.cpp
          src/stored_type.cpp src/stored_reader.cpp src/stored_source.cpp src/raw_voxels.cpp
          src/pieced_voxels.cpp src/streamed_voxels.cpp src/text_stream.cpp
          src/nrrd_reader.cpp src/nifti_reader.cpp src/metaimage_reader.cpp
          src/hdf5_reader.cpp src/dicom_reader.cpp src/dicom_series.cpp src/dicom_image.cpp
          src/vtk_reader.cpp src/vti_reader.cpp src/vti_header.cpp src/base64_stream.cpp
          src/zlib_block_stream.cpp src/picture_reader.cpp src/picture_files.cpp src/text_fields.cpp
          src/number_pattern.cpp src/raw_reader.cpp src/raw_name.cpp
          src/procedural.cpp src/vessel_tree.cpp src/ct_phantom.cpp
          src/volume_writer.cpp src/gzip_writer.cpp src/nrrd_header.cpp src/nifti_header.cpp
          src/slab_reading.cpp src/slab_scatter.cpp
          src/survey.cpp src/range_survey.cpp src/gradient_survey.cpp src/operator_weights.cpp
          src/smoothed_laplacian.cpp src/laplacian_survey.cpp
  PUBLIC burin::scene burin::mpi
  PRIVATE Teem::teem NIFTI::nifti2 GDCM::gdcm PkgConfig::HDF5 EXPAT::EXPAT ZLIB::ZLIB
          ${CMAKE_DL_LIBS})
burin_unity(burin_volumes)
# It has a readHeader of its own, as nrrd_reader.cpp does.
set_source_files_properties(src/nifti_reader.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# OpenImageIO, in a module of its own that is opened where a volume of pictures is read
# (picture_file.hpp). It lies as far from the programs of the build tree as from the installed one.
file(RELATIVE_PATH module_folder ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/burin)
add_library(burin_picture_files MODULE src/picture_module.cpp)
target_link_libraries(burin_picture_files PRIVATE OpenImageIO::OpenImageIO burin_warnings)
set_target_properties(burin_picture_files PROPERTIES
  LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${module_folder})
target_compile_definitions(burin_volumes PRIVATE
  BURIN_PICTURE_FILES_MODULE="${module_folder}/$<TARGET_FILE_NAME:burin_picture_files>")
add_dependencies(burin_volumes burin_picture_files)
