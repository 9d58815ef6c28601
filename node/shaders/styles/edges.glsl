// Pass II, edge part: ink where the surface turns away from the eye.
void apply_edges(inout Shading s, Surface g, edges_parameters p) {
  float e = (1.0 - abs(dot(g.normal, g.toEye))) * g.confidence;
  float weight = p.strength * smoothstep(p.threshold, 1.0, pow(max(e, 0.0), p.power));
  s.lineColour += weight * p.color;
  s.lineWeight += weight;
}
