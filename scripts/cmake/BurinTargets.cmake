# burin_library(NAME SOURCES ... [PUBLIC ...] [PRIVATE ...]): static library burin_NAME with alias
# burin::NAME (the name it has when installed, too), the folder's include/ directory and the
# project's warnings.
add_library(burin_warnings INTERFACE)
target_compile_options(burin_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wnon-virtual-dtor
  -Wold-style-cast $<$<BOOL:${BURIN_WARNINGS_AS_ERRORS}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # Warns of "text" + std::string when optimising (GCC bug 105651, mended in 13).
  target_compile_options(burin_warnings INTERFACE -Wno-restrict)
endif()
if(BURIN_SANITIZE)
  add_compile_options(-fsanitize=${BURIN_SANITIZE} -fno-omit-frame-pointer
                      -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${BURIN_SANITIZE})
endif()

function(burin_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(burin_${name} STATIC ${arg_SOURCES})
  add_library(burin::${name} ALIAS burin_${name})
  set_target_properties(burin_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(burin_${name} PUBLIC cxx_std_20)
  target_include_directories(burin_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(burin_${name} PUBLIC ${arg_PUBLIC}
    PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:burin_warnings>)
endfunction()
