// Pass II, highlight part: Blinn's half vector, in the light's colour.
void apply_specular(inout Shading s, Surface g, specular_parameters p) {
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 sum = lightDirection[i] + g.toEye;
    vec3 halfway = sum / max(length(sum), 1e-20);  // no direction for a light exactly behind
    float weight =
        p.strength * pow(max(dot(g.normal, halfway), 0.0), p.exponent) * g.confidence;
    s.lineColour += weight * lightColour[i];
    s.lineWeight += weight;
  }
}
