// Pass II, highlight part: Blinn's half vector, in the light's colour.
void apply_specular(inout Shading s, Surface g, specular_parameters p) {
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 halfway = normalize(lightDirection[i] + g.toEye);
    float weight =
        p.strength * pow(max(dot(g.normal, halfway), 0.0), p.exponent) * g.confidence;
    s.lineColour += weight * lightColour[i];
    s.lineWeight += weight;
  }
}
