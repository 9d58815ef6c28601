#include "transfer_function_file.hpp"

#include "burin/common/colour_map.hpp"
#include "layer_keys.hpp"

namespace burin::scene_io {

namespace {

/// What may stand in a transfer function instead of points.
struct ColourMapChoice {
  std::string file;
  std::optional<std::string> map;
  std::optional<glm::dvec2> range;
  std::optional<double> opacityUnitLength;
};

const Codec<ColourMapChoice>& colourMapChoiceCodec() {
  using C = ColourMapChoice;
  static const Codec<C> codec = object<C>(
      {required(field("file",
                      "A colour map of ParaView (JSON) or 3D Slicer (.vp, .vp.json), relative to "
                      "this file",
                      &C::file, text())),
       field("map", "Which of the file's maps; default the first", &C::map, text()),
       field("range", "Values that the map's first and last colour get; default the map's own",
             &C::range, risingPair(kAnyNumber)),
       field("opacity_unit_length",
             "World length that opacities refer to; default the map's own, or the smallest voxel "
             "spacing",
             &C::opacityUnitLength, number(kPositive))});
  return codec;
}

}  // namespace

const Document& colourMapChoiceSchema() {
  return colourMapChoiceCodec().schema;
}

void expandColourMaps(Node& scene, const std::filesystem::path& folder) {
  Node* layers = scene.find("layers");
  if (layers == nullptr) return;
  for (std::size_t i = 0; i < layers->items.size(); ++i) {
    Node* function = layers->items[i].find("transfer_function");
    if (function == nullptr || function->find("file") == nullptr) continue;
    const ColourMapChoice choice =
        colourMapChoiceCodec().read({*function, fmt::format("layers[{}].transfer_function", i)});
    const std::filesystem::path file = folder / choice.file;
    TransferFunction made =
        transferFunctionFrom(readColourMap(file, choice.map.value_or("")), choice.range);
    if (choice.opacityUnitLength) made.opacityUnitLength = choice.opacityUnitLength;
    *function = json::read(json::format(transferFunctionCodec().write(made)), file.string());
  }
}

}  // namespace burin::scene_io
