// Phong's ambient and diffuse terms; where there is no direction the colour stays unshaded.
void apply_light(inout Shading s, Surface g, light_parameters p) {
  vec3 shade = vec3(p.ambient);
  for (int i = 0; i < LIGHTS; ++i)
    shade += p.diffuse * max(dot(g.normal, lightDirection[i]), 0.0) * lightColour[i];
  s.colour *= mix(vec3(1.0), shade, g.confidence);
  s.colour = mix(s.colour, 0.5 * g.normal + 0.5, p.normal_color * g.confidence);
}
