// What the styles work on. Directions are unit vectors in world space; colours are linear RGB, not
// premultiplied; extinction is per world unit. Symbols as in the project's notation: m gradient
// magnitude over the volume's scale, q gradient confidence, e edge measure.

struct Surface {
  vec3 normal;      // n: 0 where there is no gradient
  float magnitude;  // m
  float confidence; // q(m)
  vec3 toEye;       // v
};

struct Shading {
  vec3 colour;        // pass I
  float extinction;   // pass I
  vec3 lineColour;    // pass II: sum of weight * colour
  float lineWeight;   // pass II: sum of weights
  float lineFactor;   // pass II: on the amount of lines
};

uniform vec3 eyeward, eyewardX, eyewardY;  // direction to the eye at the image centre; per pixel

vec3 directionToEye() {
  vec2 f = gl_FragCoord.xy - imageCentre;
  return normalize(eyeward + f.x * eyewardX + f.y * eyewardY);
}

uniform vec3 lightDirections[LIGHTS];
uniform vec3 lightColours[LIGHTS];
vec3 lightDirection[LIGHTS];  // world, towards the light
vec3 lightColour[LIGHTS];     // linear, times intensity

// Before the loop over samples (see `one`).
void prepareLights() {
  for (int i = 0; i < LIGHTS; ++i) {
    lightDirection[i] = one * lightDirections[i];
    lightColour[i] = one * lightColours[i];
  }
}

const int kNormalOutward = 0, kNormalInward = 1, kNormalFacing = 2;

// The unit normal of a surface, `inward`: a direction into its material, or 0.
vec3 normalAlong(vec3 inward, int orientation, vec3 toEye) {
  float size = length(inward);
  vec3 normal = size > 0.0 ? inward * (-1.0 / size) : vec3(0.0);
  if (orientation == kNormalInward) normal = -normal;
  if (orientation == kNormalFacing && dot(normal, toEye) < 0.0) normal = -normal;
  return normal;
}

// `gradient`: world direction of increasing values, its length is the magnitude over the scale.
Surface surfaceOf(vec3 gradient, float magnitude, float noiseFloor, int orientation, vec3 toEye) {
  vec3 normal = normalAlong(gradient, orientation, toEye);
  float m = min(magnitude, 1.0);
  return Surface(normal, m, smoothstep(noiseFloor, 2.0 * noiseFloor, m), toEye);
}

// e = (1 - |n.v|) q(m): nothing where there is no direction.
float edgeMeasure(Surface g) {
  return max((1.0 - abs(dot(g.normal, g.toEye))) * g.confidence, 0.0);
}

// Pass II: what lines replace of what they lie on, and their colour.
float amountOfLines(Shading s) { return clamp(s.lineWeight, 0.0, 1.0) * s.lineFactor; }
vec3 colourOfLines(Shading s) {
  return s.lineWeight > 0.0 ? s.lineColour / s.lineWeight : vec3(0.0);
}

// Pass II over pass I: lines replace colour. `classified` is the extinction before any style, of the
// transfer function or of the lines' own opacities.
void drawLines(inout Shading s, float classified) {
  if (s.lineWeight <= 0.0) return;
  float amount = amountOfLines(s);
  s.colour = mix(s.colour, colourOfLines(s), amount);
  s.extinction = max(s.extinction, classified * amount);
}
