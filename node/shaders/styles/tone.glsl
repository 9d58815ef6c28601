// Cool-to-warm light of the first light: Lum & Ma's one-dimensional tone map, or Gooch's formula.
void apply_tone(inout Shading s, Surface g, tone_parameters p) {
  float facing = dot(g.normal, lightDirection[0]);
  float amount = p.strength * g.confidence;
  if (p.mode == tone_mode_gooch) {
    vec3 warm = vec3(p.yellow, p.yellow, 0.0) + p.beta * s.colour;
    vec3 cool = vec3(0.0, 0.0, p.blue) + p.alpha * s.colour;
    s.colour = mix(s.colour, mix(cool, warm, 0.5 + 0.5 * facing), amount);
  } else {
    vec3 tone = mix(p.cool, p.warm, smoothstep(-p.transition, p.transition, facing));
    s.colour *= mix(vec3(1.0), tone, amount);
  }
}
