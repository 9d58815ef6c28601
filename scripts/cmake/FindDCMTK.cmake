# OFFIS DICOM toolkit (Debian: libdcmtk-dev). Defines DCMTK::dcmtk: data sets, and the decoders of RLE,
# JPEG and JPEG-LS. A module of our own because the packaged DCMTKConfig.cmake names the programs of
# another package, and CMake's knows none of the decoders.
find_path(DCMTK_INCLUDE_DIR dcmtk/dcmjpls/djdecode.h)
set(DCMTK_LIBRARIES)
set(DCMTK_LIBRARY_VARS)
foreach(part dcmjpeg dcmjpls dcmdata oflog ofstd)
  find_library(DCMTK_${part}_LIBRARY ${part})
  list(APPEND DCMTK_LIBRARIES ${DCMTK_${part}_LIBRARY})
  list(APPEND DCMTK_LIBRARY_VARS DCMTK_${part}_LIBRARY)
endforeach()
mark_as_advanced(DCMTK_INCLUDE_DIR ${DCMTK_LIBRARY_VARS})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(DCMTK REQUIRED_VARS ${DCMTK_LIBRARY_VARS} DCMTK_INCLUDE_DIR)

if(DCMTK_FOUND AND NOT TARGET DCMTK::dcmtk)
  add_library(DCMTK::dcmtk INTERFACE IMPORTED)
  target_include_directories(DCMTK::dcmtk INTERFACE ${DCMTK_INCLUDE_DIR})
  target_link_libraries(DCMTK::dcmtk INTERFACE ${DCMTK_LIBRARIES})
endif()
