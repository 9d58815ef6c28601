# cmake -DOUTPUT=file.cpp -DROOT=node/shaders -DFILES="a.glsl;styles/b.glsl" -P embed.cmake
# Writes a C++ file that holds every shader file as a raw string, by its path below ROOT.
set(text "// Generated from node/shaders by embed.cmake.\n#include \"shader_source.hpp\"\n\n")
string(APPEND text "namespace burin::node {\n\nstd::span<const EmbeddedShader> embeddedShaders() {\n")
string(APPEND text "  static constexpr EmbeddedShader kShaders[] = {\n")
foreach(file ${FILES})
  file(READ ${ROOT}/${file} content)
  string(APPEND text "      {\"${file}\", R\"glsl(${content})glsl\"},\n")
endforeach()
string(APPEND text "  };\n  return kShaders;\n}\n\n}  // namespace burin::node\n")
file(WRITE ${OUTPUT} "${text}")
