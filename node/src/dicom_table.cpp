#include "dicom_table.hpp"

#include <nlohmann/json.hpp>

namespace burin::node {
namespace {

using Json = nlohmann::json;

Json jsonOf(const std::optional<glm::dvec3>& vector) {
  if (!vector) return nullptr;
  return {vector->x, vector->y, vector->z};
}

std::optional<glm::dvec3> vectorIn(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return glm::dvec3{json.at(0), json.at(1), json.at(2)};
}

Json rescales(const std::vector<Rescale>& all) {
  Json json = Json::array();
  for (const Rescale& one : all) json.push_back({one.slope, one.intercept});
  return json;
}

std::vector<Rescale> rescalesIn(const Json& json) {
  std::vector<Rescale> all;
  for (const Json& one : json) all.push_back({one.at(0), one.at(1)});
  return all;
}

Json jsonOf(const DicomImage& image) {
  const StoredLayout& layout = image.layout;
  return {{"file", image.file.native()},
          {"instance", image.instance},
          {"dims", {layout.dims.x, layout.dims.y, layout.dims.z}},
          {"type", static_cast<int>(layout.type)},
          {"components", layout.components},
          {"bits", {image.bitsStored, image.highBit}},
          {"range", {image.storedRange.x, image.storedRange.y}},
          {"rescale", rescales(image.rescale)},
          {"syntax", image.syntaxUid},
          {"photometric", image.photometric},
          {"planar", image.isPlanar},
          {"position", jsonOf(image.position)},
          {"last", jsonOf(image.lastFrame)},
          {"row", jsonOf(image.row)},
          {"column", jsonOf(image.column)},
          {"spacing", {image.spacing.x, image.spacing.y}},
          {"slices", image.sliceSpacing ? Json(*image.sliceSpacing) : Json(nullptr)}};
}

DicomImage imageIn(const Json& json) {
  DicomImage image;
  image.file = json.at("file").get<std::string>();
  image.instance = json.at("instance");
  const Json& dims = json.at("dims");
  image.layout = {{dims.at(0), dims.at(1), dims.at(2)},
                  static_cast<StoredType>(json.at("type").get<int>()),
                  json.at("components")};
  image.bitsStored = json.at("bits").at(0);
  image.highBit = json.at("bits").at(1);
  image.storedRange = {json.at("range").at(0), json.at("range").at(1)};
  image.rescale = rescalesIn(json.at("rescale"));
  image.syntaxUid = json.at("syntax");
  image.photometric = json.at("photometric");
  image.isPlanar = json.at("planar");
  image.position = vectorIn(json.at("position"));
  image.lastFrame = vectorIn(json.at("last"));
  image.row = vectorIn(json.at("row"));
  image.column = vectorIn(json.at("column"));
  image.spacing = {json.at("spacing").at(0), json.at("spacing").at(1)};
  if (!json.at("slices").is_null()) image.sliceSpacing = json.at("slices").get<double>();
  return image;
}

}  // namespace

std::string writeDicomTable(const std::vector<DicomImage>& images) {
  Json table = Json::array();
  for (const DicomImage& image : images) table.push_back(jsonOf(image));
  std::string bytes;  // CBOR, for names of files need not be UTF-8
  Json::to_cbor(table, bytes);
  return bytes;
}

std::vector<DicomImage> readDicomTable(const std::string& table) {
  std::vector<DicomImage> images;
  for (const Json& image : Json::from_cbor(table)) images.push_back(imageIn(image));
  return images;
}

}  // namespace burin::node
