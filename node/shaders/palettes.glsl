// Palettes before filtering (Lum & Ma): voxels have colours, styles make of them what they would at a
// sample, and that is filtered, each quantity by itself; then they are multiplied, as texture units are.
// After voxels.glsl and shading.glsl.

// What the palette of a transfer function says of a voxel's value: straight colour, extinction.
vec4 paletteEntry(sampler1DArray palette, vec4 scale, vec2 visibleBins, float value) {
  float x = (value - scale.x) * scale.y;
  vec4 entry = texture(palette, vec2((x + 0.5) * scale.w, 0.0));
  return vec4(entry.rgb, x > visibleBins.x && x < visibleBins.y ? entry.a : 0.0);
}

// Styles are linear functions of the colour, and factors on the extinction: what they do to anything
// follows from what they do to black and to white, of extinction 1.
struct StylePalette {
  Shading black, white;
};

Shading unstyled(float grey) { return Shading(vec3(grey), 1.0, vec3(0.0), 0.0, 1.0); }

StylePalette noPalette() {
  Shading nothing = Shading(vec3(0.0), 0.0, vec3(0.0), 0.0, 0.0);
  return StylePalette(nothing, nothing);
}

void addShare(inout Shading sum, float share, Shading s) {
  sum.colour += share * s.colour;
  sum.extinction += share * s.extinction;
  sum.lineColour += share * s.lineColour;
  sum.lineWeight += share * s.lineWeight;
  sum.lineFactor += share * s.lineFactor;
}

Shading styled(vec3 colour, float extinction, StylePalette palette) {
  Shading s = palette.black;
  s.colour += colour * (palette.white.colour - palette.black.colour);
  s.extinction *= extinction;
  return s;
}
