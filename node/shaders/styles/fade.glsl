// Da: opacity of both passes by position (Lum & Ma).
void apply_fade(inout Shading s, float position, fade_parameters p) {
  float opacity = evaluateCurve(p.opacity, position);
  s.extinction *= opacity;
  s.lineFactor *= opacity;
}
