// Silhouette enhancement (Ebert & Rheingans): pass I's extinction grows where surfaces turn away from
// the eye.
void apply_silhouette(inout Shading s, Surface g, silhouette_parameters p) {
  s.extinction *= p.constant + p.scale * pow(edgeMeasure(g), p.exponent);
}
