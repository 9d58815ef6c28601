// The smoothed Laplacian over the volume's magnitude of it, in [-1, 1]; its texture has the volume's
// coordinates.

uniform sampler3D laplacianField;

float laplacianAt(vec3 coordinate) { return clamp(texture(laplacianField, coordinate).r, -1.0, 1.0); }
