// A slice from the images of its layers: simultaneous media, as the fused program sums them. The
// generated program defines LAYERS.
//
// in   layerImages: per layer (colour, optical depth) at this pixel
// out  target 0: premultiplied linear RGBA, to be blended over the frame

layout(location = 0) out vec4 result;

uniform sampler2DArray layerImages;

void main() {
  vec3 colour = vec3(0.0);
  float depth = 0.0;
  for (int i = 0; i < LAYERS; ++i) {
    vec4 layer = texelFetch(layerImages, ivec3(ivec2(gl_FragCoord.xy), i), 0);
    colour += layer.a * layer.rgb;
    depth += layer.a;
  }
  float opacity = depth > 0.0 ? opacityOf(depth) : 0.0;
  result = depth > 0.0 ? vec4(colour / depth * opacity, opacity) : vec4(0.0);
}
