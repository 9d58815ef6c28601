# cpack -G DEB in the build folder: package burin (the program and its scenes) and burin-dev (the
# libraries and headers), of what is built by then.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # not the tests first
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME burin)
set(CPACK_PACKAGE_VENDOR burin)
set(CPACK_PACKAGE_CONTACT "the burin authors <burin@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME burin)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# What no linker sees: the launcher, OpenGL, which is opened at run time, and the font of labels. Without
# the MRI volume the demo scene alone cannot be drawn.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "openmpi-bin, libosmesa6, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri, mricron-data")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME burin-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libopenmpi-dev, libfmt-dev, libglm-dev, libzstd-dev, pkgconf")
include(CPack)
