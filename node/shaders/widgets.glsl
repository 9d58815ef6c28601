// Two-dimensional transfer functions (Kniss et al. 2001): regions of value and gradient magnitude m,
// evaluated as they are instead of looked up, so that they are exact at any precision of the values.
// Along a segment the value is taken to go linearly from one end's to the other's; a region's part of
// its largest extinction is the mean over the values between, in closed form, at the middle's m.
// Values are stored ones. What the four vectors of a region hold: widgetRows() in widget_code.hpp.

// 1 if a region may show any of the values between two, else 0.
float widgetShows(vec4 range, float front, float back) {
  return max(front, back) > range.x && min(front, back) < range.y ? 1.0 : 0.0;
}

// Triangles and rectangles. The shape is linear in each third of what lies between its edges, so the
// middle of each third's part says its integral, and nothing cancels in narrow segments.
float trapezoidMean(vec4 range, vec4 edges, vec4 along, float front, float back, float m) {
  float share = clamp(min((m - along.x) * along.y, (along.z - m) * along.w), 0.0, 1.0);
  float low = edges.x + m * edges.y;
  float high = edges.z + m * edges.w;
  float perHalf = 2.0 / max(high - low, 1e-20);
  float a = (front - range.x - low) * perHalf - 1.0;  // -1 and 1 at the edges
  float b = (back - range.x - low) * perHalf - 1.0;
  float first = min(a, b);
  float last = max(a, b);
  vec3 begin = vec3(-1.0, -range.w, range.w);
  vec3 end = vec3(-range.w, range.w, 1.0);
  vec3 from = clamp(vec3(first), begin, end);
  vec3 to = clamp(vec3(last), begin, end);
  vec3 height = clamp((1.0 - abs(0.5 * (from + to))) * range.z, 0.0, 1.0);
  float middle = clamp((1.0 - abs(0.5 * (a + b))) * range.z, 0.0, 1.0);
  float span = last - first;
  return share * (span > 1e-6 ? dot(to - from, height) / span : middle);
}

// Ellipses: (room - u^2)^2 over the value u, of which three points of Gauss and Legendre say the
// integral exactly.
float ellipseMean(vec4 range, vec4 ellipse, float front, float back, float m) {
  float up = (m - ellipse.z) * ellipse.w;
  float room = max(1.0 - up * up, 0.0);
  float reach = sqrt(room);
  float a = (front - range.x) * ellipse.y - 1.0;
  float b = (back - range.x) * ellipse.y - 1.0;
  float from = clamp(min(a, b), -reach, reach);
  float to = clamp(max(a, b), -reach, reach);
  vec3 at = 0.5 * (from + to) + 0.5 * (to - from) * vec3(-0.774596669, 0.0, 0.774596669);
  vec3 inside = max(room - at * at, 0.0);
  float middle = max(room - 0.25 * (a + b) * (a + b), 0.0);
  float span = abs(b - a);
  float mean = dot(inside * inside, vec3(5.0, 8.0, 5.0) / 18.0) * (to - from) / span;
  return span > 1e-6 ? mean : middle * middle;
}

// `sum`: (extinction * colour, extinction) of the regions so far.
void addWidget(inout vec4 sum, vec4 look, float part) {
  float extinction = look.a * part;
  sum += vec4(look.rgb * extinction, extinction);
}
