# cmake --install: the program, the scenes, the documents; and for other programs (find_package(burin))
# the libraries of common/ and compositor/ with their headers. Those of node/ and host/ stay inside:
# they would drag OpenGL, file formats and their find modules into everybody's build.
include(CMakePackageConfigHelpers)
set(burin_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/burin)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(TARGETS burin_core burin_scene burin_wire burin_mpi burin_compositor EXPORT burinTargets)
install(DIRECTORY common/include/ compositor/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp")
install(EXPORT burinTargets NAMESPACE burin:: DESTINATION ${burin_package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/burinConfig.cmake.in
  ${CMAKE_BINARY_DIR}/burinConfig.cmake INSTALL_DESTINATION ${burin_package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/burinConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/burinConfig.cmake ${CMAKE_BINARY_DIR}/burinConfigVersion.cmake
        DESTINATION ${burin_package_dir})

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS burin RUNTIME)
install(TARGETS burin_pictures burin_picture_files burin_formats
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/burin)
install(DIRECTORY configs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/burin/configs
        FILES_MATCHING PATTERN "*.json")
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
