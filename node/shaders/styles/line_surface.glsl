// S2: the amount of lines by gradient magnitude (Lum & Ma).
void apply_line_surface(inout Shading s, Surface g, line_surface_parameters p) {
  s.lineFactor *= evaluateCurve(p.opacity, g.magnitude);
}
