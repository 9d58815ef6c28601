// Creases: another colour where the smoothed Laplacian is above one threshold or below another.
void apply_laplacian(inout Shading s, float laplacian, laplacian_parameters p) {
  float valley = smoothstep(p.above, p.above + p.softness, laplacian);
  float ridge = smoothstep(p.below, p.below + p.softness, -laplacian);
  s.colour = mix(s.colour, p.color, p.strength * max(valley, ridge));
}
