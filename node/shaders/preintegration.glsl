// Pre-integrated classification (Engel et al. 2001), in one dimension: along a segment the value is
// taken to go linearly from one end's to the other's, so the segment's extinction is the mean of
// the transfer function's over the values between, its colour their mean weighted by extinction.
// Nothing of a transfer function is missed, however narrow: the table's bins hold its means.
//
// A layer's tables are TransferRows (transfer_table.hpp); the extinction's filters to the nearest
// texel, as texelFetch would cost twice as much. Values are in bins of the table: 0 at its first
// entry, n at its last. Bins -1 and n go on to either side with the ends' values.

// What a layer says of one end of a segment.
struct EndClass {
  float x;             // value in bins
  float high, low;     // integral of the extinction up to there: their sum
  float extinction;    // there
  vec4 emission;       // integrals of extinction * colour, and of the extinction, up to there but
                       // within the table
};

// scale: (first value, bins per unit of value, number of bins, 1 / texels)
EndClass classifyEnd(sampler1DArray tables, sampler1D extinctions, vec4 scale, float value) {
  EndClass at;
  at.x = (value - scale.x) * scale.y;
  float bin = clamp(floor(at.x), -1.0, scale.z);
  vec4 entry = texture(extinctions, (bin + 1.5) * scale.w);
  float t = at.x - bin;
  at.high = entry.x;
  at.low = entry.y + t * (entry.z + 0.5 * t * entry.w);
  at.extinction = entry.z + t * entry.w;
  float texel = (clamp(at.x, 0.0, scale.z) + 0.5) * scale.w;
  at.emission = texture(tables, vec2(texel, 1.0));
  return at;
}

bool beyondTable(vec4 scale, EndClass a, EndClass b) {
  return max(a.x, b.x) <= 0.0 || min(a.x, b.x) >= scale.z;
}

// Mean extinction over the values between two ends. The two floats keep what their difference needs
// down to 1/32 bin; below it is the ends' mean, wrong by at most 1/128 of a bin's change. Beyond the
// table the ends' mean is exact, while the integral's rounding grows with the distance: a table may
// be a millionth of the values wide.
float meanExtinction(vec4 scale, EndClass a, EndClass b) {
  float span = b.x - a.x;
  bool wide = abs(span) > 1.0 / 32.0 && !beyondTable(scale, a, b);
  precise float integral = (b.high - a.high) + (b.low - a.low);
  return wide ? max(integral / span, 0.0) : 0.5 * (a.extinction + b.extinction);
}

// The middle value's colour.
vec3 middleColour(sampler1DArray tables, vec4 scale, EndClass a, EndClass b) {
  return texture(tables, vec2((0.5 * (a.x + b.x) + 0.5) * scale.w, 0.0)).rgb;
}

// Colour of the same: of the middle value where the ends are less than a bin apart, the mean
// weighted by extinction, whose differences of floats need some distance, from two bins on.
// first, end: the table's first and last entries, which go on to either side.
vec3 meanColour(sampler1DArray tables, vec4 scale, vec4 first, vec4 end, EndClass a,
                EndClass b) {
  float low = min(a.x, b.x);
  float high = max(a.x, b.x);
  vec3 middle = middleColour(tables, scale, a, b);
  vec4 sum = a.x < b.x ? b.emission - a.emission : a.emission - b.emission;
  sum += max(-low, 0.0) * first.a * vec4(first.rgb, 1.0);
  sum += max(high - scale.z, 0.0) * end.a * vec4(end.rgb, 1.0);
  float wide = sum.a > 0.0 ? clamp(high - low - 1.0, 0.0, 1.0) : 0.0;
  return mix(middle, max(sum.rgb, 0.0) * (1.0 / max(sum.a, 1e-30)), wide);
}

// Where two segments meet: the volume's value there and its class by every transfer function, those of
// the layers' lines included (LAYERS).
struct Side {
  float value;
  float valid;
  EndClass layers[LAYERS];
};
