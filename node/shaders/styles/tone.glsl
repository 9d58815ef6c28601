// Tone by the angle to the first light: Lum & Ma's one-dimensional tone map, of two colours or of any,
// or Gooch's formula; Ebert & Rheingans' sum of that over all lights.
void apply_tone(inout Shading s, Surface g, tone_parameters p) {
  float facing = dot(g.normal, lightDirection[0]);
  float amount = p.strength * g.confidence;
  vec3 warm = vec3(p.yellow, p.yellow, 0.0) + p.beta * s.colour;
  vec3 cool = vec3(0.0, 0.0, p.blue) + p.alpha * s.colour;
  if (p.mode == tone_mode_gooch) {
    s.colour = mix(s.colour, mix(cool, warm, 0.5 + 0.5 * facing), amount);
  } else if (p.mode == tone_mode_ebert) {
    vec3 sum = p.ambient * s.colour;
    for (int i = 0; i < LIGHTS; ++i) {
      float cosine = dot(g.normal, lightDirection[i]);
      sum += mix(cool, warm, 0.5 + 0.5 * cosine);
      sum += p.diffuse * max(cosine, 0.0) * lightColour[i] * s.colour;
    }
    s.colour = mix(s.colour, sum, amount);
  } else {
    vec3 tone = mix(p.cool, p.warm, smoothstep(-p.transition, p.transition, facing));
    if (p.mode == tone_mode_colors) tone = evaluateColourCurve(p.colors, facing);
    s.colour *= mix(vec3(1.0), tone, amount);
  }
}
