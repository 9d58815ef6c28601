// Pre-integrated classification (Engel et al. 2001), in one dimension: along a segment the value is
// taken to go linearly from one end's to the other's, so the segment's extinction is the mean of
// the transfer function's over the values between, its colour their mean weighted by extinction.
// Nothing of a transfer function is missed, however narrow: the table's bins hold its means.
//
// A layer's tables are the rows of one texture (TransferRows, transfer_table.hpp). Values are in
// bins of the table: 0 at its first entry, n at its last. Bins -1 and n go on to either side with
// the ends' values.

// What a layer says of one end of a segment: (value in bins; integral of the extinction up to there
// in two floats whose sum counts; extinction there).
// scale: (first value, bins per unit of value, number of bins, 1 / texels)
vec4 classifyEnd(sampler1DArray tables, vec4 scale, float value) {
  float x = (value - scale.x) * scale.y;
  float bin = clamp(floor(x), -1.0, scale.z);
  vec4 entry = texelFetch(tables, ivec2(int(bin) + 1, 2), 0);
  float t = x - bin;
  return vec4(x, entry.x, entry.y + t * (entry.z + 0.5 * t * entry.w), entry.z + t * entry.w);
}

// Mean extinction over the values between two ends. The two floats keep what their difference needs
// down to 1/32 bin; below it is the ends' mean, wrong by at most 1/128 of a bin's change. Beyond the
// table the ends' mean is exact, while the integral's rounding grows with the distance: a table may
// be a millionth of the values wide.
float meanExtinction(vec4 scale, vec4 a, vec4 b) {
  float span = b.x - a.x;
  bool beyond = max(a.x, b.x) <= 0.0 || min(a.x, b.x) >= scale.z;
  bool wide = abs(span) > 1.0 / 32.0 && !beyond;
  precise float integral = (b.y - a.y) + (b.z - a.z);
  return wide ? max(integral / span, 0.0) : 0.5 * (a.w + b.w);
}

// Colour of the same: of the middle value where the ends are less than a bin apart, the mean
// weighted by extinction, whose differences of floats need some distance, from two bins on.
// first, end: the table's first and last entries; scale.w: 1 / texels of the table.
vec3 meanColour(sampler1DArray tables, vec4 scale, vec4 first, vec4 end, vec4 a, vec4 b) {
  float low = min(a.x, b.x);
  float high = max(a.x, b.x);
  vec3 middle = texture(tables, vec2((0.5 * (low + high) + 0.5) * scale.w, 0.0)).rgb;
  float from = clamp(low, 0.0, scale.z);
  float to = clamp(high, 0.0, scale.z);
  vec4 sum = texture(tables, vec2((to + 0.5) * scale.w, 1.0)) -
             texture(tables, vec2((from + 0.5) * scale.w, 1.0));
  sum += max(from - low, 0.0) * first.a * vec4(first.rgb, 1.0);
  sum += max(high - to, 0.0) * end.a * vec4(end.rgb, 1.0);
  float wide = sum.a > 0.0 ? clamp(high - low - 1.0, 0.0, 1.0) : 0.0;
  return mix(middle, max(sum.rgb, 0.0) / max(sum.a, 1e-30), wide);
}

// Where two segments meet: the volume's value there and its class in every layer.
struct Side {
  float value;
  float valid;
  vec4 layers[LAYERS];
};
