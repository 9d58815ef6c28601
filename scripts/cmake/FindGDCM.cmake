# Grassroots DICOM (Debian: libgdcm-dev). Defines GDCM::gdcm.
# A module of our own because the packaged GDCMConfig.cmake names files of packages for other languages.
find_path(GDCM_INCLUDE_DIR gdcmImageRegionReader.h PATH_SUFFIXES gdcm-3.0)
foreach(part MSFF DSED DICT Common)
  find_library(GDCM_${part}_LIBRARY gdcm${part})
  list(APPEND GDCM_LIBRARIES ${GDCM_${part}_LIBRARY})
  list(APPEND GDCM_LIBRARY_VARS GDCM_${part}_LIBRARY)
endforeach()
mark_as_advanced(GDCM_INCLUDE_DIR ${GDCM_LIBRARY_VARS})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(GDCM REQUIRED_VARS ${GDCM_LIBRARY_VARS} GDCM_INCLUDE_DIR)

if(GDCM_FOUND AND NOT TARGET GDCM::gdcm)
  add_library(GDCM::gdcm INTERFACE IMPORTED)
  target_include_directories(GDCM::gdcm INTERFACE ${GDCM_INCLUDE_DIR})
  target_link_libraries(GDCM::gdcm INTERFACE ${GDCM_LIBRARIES})
endif()
