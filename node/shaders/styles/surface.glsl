// S1: pass I's opacity by gradient magnitude (Lum & Ma, surface enhancement).
void apply_surface(inout Shading s, Surface g, surface_parameters p) {
  s.extinction *= evaluateCurve(p.opacity, g.magnitude);
}
