// Feature halos (Ebert & Rheingans): a medium of its own colour outside of features. `nearby`: haloAt(),
// per world unit.
void apply_halo(inout Shading s, Surface g, float nearby, halo_parameters p) {
  float extinction = p.strength * (1.0 - g.magnitude) * nearby;
  float both = s.extinction + extinction;
  if (both > 0.0) s.colour = (s.extinction * s.colour + extinction * p.color) / both;
  s.extinction = both;
}
