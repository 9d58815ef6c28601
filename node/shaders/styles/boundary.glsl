// Boundary enhancement (Ebert & Rheingans): pass I's extinction grows with the gradient magnitude.
void apply_boundary(inout Shading s, Surface g, boundary_parameters p) {
  s.extinction *= p.constant + p.scale * pow(g.magnitude, p.exponent);
}
