# Voxels as files hold them, on their way to a brick: what every reader stands on.
burin_library(stored
  SOURCES src/brick_source.cpp src/stored_type.cpp src/stored_reader.cpp src/stored_source.cpp
          src/stored_voxels.cpp src/raw_voxels.cpp src/pieced_voxels.cpp src/streamed_voxels.cpp
          src/text_stream.cpp src/gzip_stream.cpp src/file_handle.cpp src/byte_order.cpp
          src/voxel_access.cpp src/text_fields.cpp
  PUBLIC burin::scene
  PRIVATE ZLIB::ZLIB)

# Brick sources (files and procedural volumes), the volume writer, the survey.
burin_library(volumes
  SOURCES src/open_volume.cpp src/nrrd_reader.cpp src/slicer_segments.cpp src/nifti_reader.cpp src/metaimage_reader.cpp
          src/module_formats.cpp src/module_function.cpp src/hdf5_name.cpp src/dicom_folder.cpp
          src/vtk_reader.cpp src/vti_reader.cpp src/vti_header.cpp src/base64_stream.cpp
          src/zlib_block_stream.cpp src/picture_reader.cpp src/picture_files.cpp
          src/number_pattern.cpp src/raw_reader.cpp src/raw_name.cpp
          src/procedural.cpp src/vessel_tree.cpp src/ct_phantom.cpp
          src/volume_writer.cpp src/gzip_writer.cpp src/nrrd_header.cpp src/nifti_header.cpp
          src/slab_reading.cpp src/slab_scatter.cpp
          src/survey.cpp src/range_survey.cpp src/gradient_survey.cpp src/operator_weights.cpp
          src/smoothed_laplacian.cpp src/laplacian_survey.cpp
          src/label_voxels.cpp src/label_volume.cpp
  PUBLIC burin::stored burin::scene burin::mpi
  PRIVATE Teem::teem NIFTI::nifti2 EXPAT::EXPAT ZLIB::ZLIB ${CMAKE_DL_LIBS})
burin_unity(burin_stored)
burin_unity(burin_volumes)
# It has a readHeader of its own, as nrrd_reader.cpp does.
set_source_files_properties(src/nifti_reader.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# Large libraries are in modules of their own, opened where a file needs them: OpenImageIO
# (picture_file.hpp), HDF5 and DCMTK (format_module.hpp). They lie as far from the programs of the
# build tree as from the installed one.
file(RELATIVE_PATH module_folder ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/burin)
# burin_volumes_module(NAME MACRO): burin::volumes knows the module's place by that macro.
function(burin_volumes_module name macro)
  set_target_properties(${name} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${module_folder})
  target_compile_definitions(burin_volumes PRIVATE
    ${macro}="${module_folder}/$<TARGET_FILE_NAME:${name}>")
  add_dependencies(burin_volumes ${name})
endfunction()

add_library(burin_picture_files MODULE src/picture_module.cpp)
target_link_libraries(burin_picture_files PRIVATE OpenImageIO::OpenImageIO burin_warnings)
burin_volumes_module(burin_picture_files BURIN_PICTURE_FILES_MODULE)

add_library(burin_formats MODULE src/format_module.cpp
  src/hdf5_volume.cpp src/hdf5_voxels.cpp src/hdf5_dataset.cpp src/hdf5_id.cpp src/hdf5_name.cpp
  src/dicom_volume.cpp src/dicom_table.cpp src/dicom_series.cpp src/dicom_folder.cpp
  src/dicom_image.cpp src/dicom_syntax.cpp src/dicom_pixels.cpp src/dicom_file.cpp
  src/jpeg_header.cpp)
target_link_libraries(burin_formats PRIVATE burin::stored nlohmann_json::nlohmann_json
  DCMTK::dcmtk PkgConfig::HDF5 burin_warnings)
target_include_directories(burin_formats PRIVATE include)
# What it has in common with the program stays its own.
target_link_options(burin_formats PRIVATE -Wl,--exclude-libs,ALL)
burin_volumes_module(burin_formats BURIN_FORMATS_MODULE)
burin_unity(burin_formats)
