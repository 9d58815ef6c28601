// Pass II, edge part: ink where the surface turns away from the eye.
void apply_edges(inout Shading s, Surface g, edges_parameters p) {
  float weight = p.strength * smoothstep(p.threshold, 1.0, pow(edgeMeasure(g), p.power));
  s.lineColour += weight * p.color;
  s.lineWeight += weight;
}
