// Dc: colour by position (Lum & Ma), a factor and then a blend, as a factor alone cannot lighten; or
// Ebert & Rheingans' distance colouring.
void apply_depth(inout Shading s, float position, depth_parameters p) {
  if (p.mode == depth_mode_distance) {
    s.colour = mix(s.colour, p.color, p.strength * pow(position, p.exponent));
  } else {
    s.colour *= evaluateColourCurve(p.factor, position);
    s.colour = mix(s.colour, p.color, evaluateCurve(p.blend, position));
  }
}
