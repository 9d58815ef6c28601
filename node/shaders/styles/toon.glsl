// Toon shading: the light's intensity I in q steps, tone min(q - 1, floor(q I)) of 0 … q - 1, the colour
// itself the darkest, white the lightest. A step is `softness` wide: where it falls in a ray must not
// hang on the last bit of a look-up.
void apply_toon(inout Shading s, Surface g, toon_parameters p) {
  const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);  // of linear sRGB
  float intensity = 0.0;
  for (int i = 0; i < LIGHTS; ++i)
    intensity += max(dot(g.normal, lightDirection[i]), 0.0) * dot(lightColour[i], kLuminance);
  float x = p.tones * min(intensity, 1.0);
  float nearest = floor(x + 0.5);  // step
  float tone = nearest - 1.0 + clamp((x - nearest) / p.softness + 0.5, 0.0, 1.0);
  float light = clamp(tone / (p.tones - 1.0), 0.0, 1.0);
  s.colour = mix(s.colour, vec3(1.0), p.strength * g.confidence * light);
}
