#include <functional>
#include <nlohmann/json.hpp>

#include "mdat/source/sha256.hpp"
#include "ut/mdat/missiondb/mesh_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Gltf = nlohmann::json;

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string data_uri(const std::string& bytes) { return "data:application/octet-stream;base64," + base64(bytes); }

// The box: positions of `component` type from `position`, then indices of 16 bits.
struct Parts {
  std::string bytes;
  Gltf json;
};
Parts box_parts(int component, const std::function<std::string(const Vector3d&)>& position) {
  std::string positions, indices;
  for (const Vector3d& v : box().vertices) positions += position(v);
  for (const auto& t : box().triangles) {
    for (const auto k : t) indices += raw(static_cast<std::uint16_t>(k));
  }
  const std::size_t stride = positions.size() / box().vertices.size();
  Gltf json = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes", {{{"mesh", 0}}}},
               {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
               {"accessors",
                {{{"bufferView", 0}, {"componentType", component}, {"count", 8}, {"type", "VEC3"}},
                 {{"bufferView", 1}, {"componentType", 5123}, {"count", 36}, {"type", "SCALAR"}}}},
               {"bufferViews",
                {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", positions.size()}, {"byteStride", stride}},
                 {{"buffer", 0}, {"byteOffset", positions.size()}, {"byteLength", indices.size()}}}},
               {"buffers", {{{"byteLength", positions.size() + indices.size()}}}}};
  return {positions + indices, json};
}
Parts box_parts() { return box_parts(5126, raw_point); }

std::string with_data(const Parts& parts) {
  Gltf json = parts.json;
  json["buffers"][0]["uri"] = data_uri(parts.bytes);
  return json.dump();
}

std::string chunk(std::string bytes, const char* kind, char fill) {
  while (bytes.size() % 4 != 0) bytes += fill;
  return raw(static_cast<std::uint32_t>(bytes.size())) + std::string(kind, 4) + bytes;
}
std::string glb(const Parts& parts) {
  const std::string chunks = chunk(parts.json.dump(), "JSON", ' ') + chunk(parts.bytes, "BIN\0", '\0');
  return "glTF" + raw(std::uint32_t{2}) + raw(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

TEST(GltfReader, DataUrisAndBinary) {
  VERIFIES("LASSO-GND-005~2");
  const Parts parts = box_parts();
  const std::string text = with_data(parts);
  expect_box(imported("g.gltf", text));
  expect_box(imported("g.gltf", "\xEF\xBB\xBF" + text));
  expect_box(imported("g.gltf", changed(text, "data:application/octet-stream;", "data:;")));
  expect_box(imported("g.gltf", changed(text, "=", "")));  // without padding
  expect_box(imported("g.GLB", glb(parts)));
  expect_box(imported("g.gltf", glb(parts)));  // whatever the name says
  expect_box(imported("g.glb", glb(parts) + "behind"));
  Parts bare = parts;
  bare.json["asset"]["version"] = "2.1";
  bare.json.erase("scene");
  expect_box(imported("g.glb", glb(bare)));
  bare.json.erase("scenes");
  expect_box(imported("g.glb", glb(bare)));
}

TEST(GltfReader, BuffersBesideIt) {
  VERIFIES("LASSO-GND-005~2");
  const Folder folder;
  Parts parts = box_parts();
  for (const auto& [uri, name] : {std::pair{"body.bin", "body.bin"},
                                  {"my%20body.bin", "my body.bin"},
                                  {"my body.bin", "my body.bin"},
                                  {"K%C3%B6rper%231.bin", "K\xC3\xB6rper#1.bin"},
                                  {"./a%2Db.bin", "a-b.bin"},
                                  {"50%.bin", "50%.bin"},
                                  {"as%20it%20is.bin", "as%20it%20is.bin"}}) {
    SCOPED_TRACE(uri);
    folder.write(name, parts.bytes);
    parts.json["buffers"][0]["uri"] = uri;
    expect_box(import_mesh(folder.write("g.gltf", parts.json.dump()), 1));
  }
  const auto said = [&](const std::string& uri) {
    parts.json["buffers"][0]["uri"] = uri;
    try {
      static_cast<void>(import_mesh(folder.write("g.gltf", parts.json.dump()), 1));
    } catch (const MeshError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(said("gone.bin"), "refers to \"gone.bin\", which cannot be read: No such file or directory");
  EXPECT_EQ(said("https://example.org/a.bin"), "refers to \"https://example.org/a.bin\", expected a file beside it: fetch it");
  EXPECT_EQ(said(std::string(5000, 'a')), "refers to \"" + std::string(40, 'a') + "...\", which cannot be read: File name too long");
  folder.write("short.bin", parts.bytes.substr(1));
  EXPECT_EQ(said("short.bin"), "has a glTF buffer of 167 bytes, 168 are announced: it is truncated or corrupt");
  EXPECT_EQ(said("data:;base64,*"), "has a data URI that is not base64: the file is truncated or corrupt");
}

// What KHR_mesh_quantization allows, decoded by its closed form: the box in 1/1000, or as shares of the range of an integer.
TEST(GltfReader, QuantisedPositions) {
  VERIFIES("LASSO-GND-005~2");
  const auto integers = [](auto example, double factor, std::size_t padding) {
    return [=](const Vector3d& v) {
      std::string bytes;
      for (const double x : v) bytes += raw(static_cast<decltype(example)>(std::lround(factor * x)));
      return bytes + std::string(padding, '\0');
    };
  };
  const auto scaled = [](Parts parts, double scale, bool normalized) {
    parts.json["nodes"][0]["scale"] = {scale, scale, scale};
    parts.json["accessors"][0]["normalized"] = normalized;
    parts.json["extensionsRequired"] = parts.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    return with_data(parts);
  };
  expect_box(imported("q.gltf", scaled(box_parts(5122, integers(std::int16_t{}, 1000, 2)), 0.001, false)));
  expect_box(imported("q.gltf", scaled(box_parts(5120, integers(std::int8_t{}, 50, 1)), 0.02, false)));
  expect_box(imported("q.gltf", scaled(box_parts(5122, integers(std::int16_t{}, 10000, 2)), 3.2767, true)));
  expect_box(imported("q.gltf", scaled(box_parts(5120, integers(std::int8_t{}, 50, 1)), 2.54, true)));
  const auto shifted = [](auto example, double factor) {  // unsigned: about (2.5, 2.5, 2.5)
    return [=](const Vector3d& v) {
      std::string bytes;
      for (const double x : v) bytes += raw(static_cast<decltype(example)>(std::lround(factor * (x + 2.5))));
      return bytes + std::string(4 - 3 * sizeof example % 4, '\0');
    };
  };
  const Vector3d center(2.5, 2.5, 2.5);
  expect_box(imported("q.gltf", scaled(box_parts(5123, shifted(std::uint16_t{}, 10000)), 0.0001, false)), 1, center);
  expect_box(imported("q.gltf", scaled(box_parts(5123, shifted(std::uint16_t{}, 10000)), 6.5535, true)), 1, center);
  expect_box(imported("q.gltf", scaled(box_parts(5121, shifted(std::uint8_t{}, 50)), 0.02, false)), 1, center);
  expect_box(imported("q.gltf", scaled(box_parts(5121, shifted(std::uint8_t{}, 50)), 5.1, true)), 1, center);
}

TEST(GltfReader, ExtensionsThatAreNotReadAreNamed) {
  VERIFIES("LASSO-GND-014~1 LASSO-GND-005~2");
  const auto with = [](const char* list, const char* name) {
    Parts parts = box_parts();
    parts.json[list] = {name};
    return with_data(parts);
  };
  for (const char* name :
       {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing", "EXT_some_unknown_geometry"}) {
    EXPECT_EQ(refusal("g.gltf", with("extensionsRequired", name)),
              std::string("requires the glTF extension \"") + name + "\", which is not read: export without it");
    std::vector<std::string> left_out;
    expect_box(imported("g.gltf", with("extensionsUsed", name), &left_out));
    EXPECT_EQ(left_out, std::vector<std::string>{std::string("the glTF extension \"") + name + '"'});
  }
  for (const char* name : {"KHR_materials_unlit", "KHR_texture_transform", "EXT_texture_webp", "KHR_lights_punctual"}) {
    std::vector<std::string> left_out;
    expect_box(imported("g.gltf", with("extensionsRequired", name), &left_out));
    EXPECT_TRUE(left_out.empty());
  }
}

TEST(GltfReader, LinesAndPointsAreTold) {
  VERIFIES("LASSO-GND-005~2");
  Parts parts = box_parts();
  Gltf& primitives = parts.json["meshes"][0]["primitives"];
  for (const int mode : {0, 1, 2, 3}) {
    primitives.push_back(primitives[0]);
    primitives.back()["mode"] = mode;
  }
  std::vector<std::string> left_out;
  expect_box(imported("l.gltf", with_data(parts), &left_out));
  EXPECT_EQ(left_out, std::vector<std::string>{"4 primitives of lines or points"});
  primitives.erase(0);
  EXPECT_EQ(refusal("l.gltf", with_data(parts)), "is empty: it holds no triangle, but lines or points: export triangles");
}

TEST(GltfReader, StripsFansAndPlainCorners) {
  VERIFIES("LASSO-GND-005~2");
  Parts parts = box_parts();
  // strips of the sides and of both ends
  std::string strips;
  for (const int k : {4, 0, 5, 1, 7, 3, 6, 2, 4, 0, 1, 0, 3, 2, 4, 5, 6, 7}) strips += raw(static_cast<std::uint16_t>(k));
  parts.bytes.replace(96, strips.size(), strips);
  Gltf& accessors = parts.json["accessors"];
  Gltf& primitives = parts.json["meshes"][0]["primitives"];
  const auto list = [&](std::size_t offset, std::size_t count) {
    accessors.push_back({{"bufferView", 1}, {"byteOffset", 2 * offset}, {"componentType", 5123}, {"count", count}, {"type", "SCALAR"}});
    return accessors.size() - 1;
  };
  primitives = {{{"attributes", {{"POSITION", 0}}}, {"indices", list(0, 10)}, {"mode", 5}},
                {{"attributes", {{"POSITION", 0}}}, {"indices", list(10, 4)}, {"mode", 5}},
                {{"attributes", {{"POSITION", 0}}}, {"indices", list(14, 4)}, {"mode", 5}}};
  expect_box(imported("s.gltf", with_data(parts)));
  // a fan of the four corners at +x, and the same as corners without indices are flat: two triangles of 3 x 5
  primitives = {{{"attributes", {{"POSITION", 0}}}, {"mode", 6}}};
  EXPECT_EQ(imported("f.gltf", with_data(parts)).triangles.size(), 6u);
  accessors[0]["count"] = 6;
  primitives[0]["mode"] = 4;
  EXPECT_EQ(imported("c.gltf", with_data(parts)).triangles.size(), 2u);
  accessors[0]["count"] = 7;
  EXPECT_EQ(refusal("c.gltf", with_data(parts)), "has triangles of 7 corners, no multiple of 3");
}

TEST(GltfReader, NodesPlaceTurnScaleAndMirror) {
  VERIFIES("LASSO-GND-005~2");
  Parts parts = box_parts();
  Gltf& nodes = parts.json["nodes"];
  nodes = {{{"children", {1}}, {"translation", {1, 2, 3}}}, {{"mesh", 0}, {"scale", {2, 2, 2}}}};
  expect_box(imported("n.gltf", with_data(parts)), 2, {1, 2, 3});
  nodes[1] = {{"mesh", 0}, {"scale", {-1, 1, 1}}};  // still outwards: the volume is positive
  expect_box(imported("n.gltf", with_data(parts)), 1, {1, 2, 3});
  nodes[1] = {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 0, 0, 1}}};
  expect_box(imported("n.gltf", with_data(parts)), 1, {5, 2, 3});
  nodes[0]["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // a quarter turn about z: x to y
  nodes[1] = {{"mesh", 0}, {"translation", {4, 0, 0}}};
  const Mesh turned = imported("n.gltf", with_data(parts));
  Eigen::AlignedBox3d bounds;
  for (const Vector3d& v : turned.vertices) bounds.extend(v);
  EXPECT_LT((bounds.center() - Vector3d(1, 6, 3)).norm(), 1e-6);
  EXPECT_LT((bounds.sizes() - Vector3d(3, 2, 5)).norm(), 1e-5);
  nodes[1]["children"] = {0};
  EXPECT_EQ(refusal("n.gltf", with_data(parts)), "is a corrupt glTF file: a node is in itself, or in two others");
}

TEST(GltfReader, SparsePositions) {
  VERIFIES("LASSO-GND-005~2");
  Parts parts = box_parts();
  // vertex 7 stands elsewhere in the accessor, and is put right by the sparse entry
  const std::string right = raw_point(box().vertices[7]);
  parts.bytes.replace(7 * 12, 12, std::string(12, '\0'));
  const std::size_t begin = parts.bytes.size();
  parts.bytes += raw(std::uint32_t{7}) + right;
  parts.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", 4}});
  parts.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin + 4}, {"byteLength", 12}});
  parts.json["buffers"][0]["byteLength"] = parts.bytes.size();
  Gltf& sparse = parts.json["accessors"][0]["sparse"];
  sparse = {{"count", 1}, {"indices", {{"bufferView", 2}, {"componentType", 5125}}}, {"values", {{"bufferView", 3}}}};
  expect_box(imported("s.gltf", with_data(parts)));
  parts.bytes.replace(begin, 1, "\x08");
  EXPECT_EQ(refusal("s.gltf", with_data(parts)), "has a sparse glTF accessor whose indices lie beyond its entries");
}

TEST(GltfReader, FurtherScenesAndBonesAreTold) {
  VERIFIES("LASSO-GND-005~2");
  Parts parts = box_parts();
  parts.json["scenes"].push_back({{"nodes", {0}}});
  parts.json["nodes"][0]["skin"] = 0;
  std::vector<std::string> left_out;
  expect_box(imported("g.gltf", with_data(parts), &left_out));
  EXPECT_EQ(left_out,
            (std::vector<std::string>{"1 further scene", "the bones or morphs of 1 node: the mesh is read as it is without them"}));
}

TEST(GltfReader, RefusesWhatDoesNotFit) {
  VERIFIES("LASSO-GND-014~1");
  const auto said = [](const std::function<void(Gltf&)>& change) {
    Parts parts = box_parts();
    change(parts.json);
    return refusal("g.gltf", with_data(parts));
  };
  const std::string beyond = "has a glTF accessor whose count does not fit its buffer: the file is truncated or corrupt";
  EXPECT_EQ(said([](Gltf& g) { g["accessors"][0]["count"] = 9; }), beyond);
  EXPECT_EQ(said([](Gltf& g) { g["accessors"][1]["count"] = 36000000000; }), beyond);
  EXPECT_EQ(said([](Gltf& g) { g["bufferViews"][1]["byteOffset"] = 97; }),
            "has a glTF accessor whose bytes lie beyond its buffer: the file is truncated or corrupt");
  EXPECT_EQ(said([](Gltf& g) { g["accessors"][0]["count"] = "many"; }),
            "is a corrupt glTF file: \"count\" is of the wrong type, expected a number");
  EXPECT_EQ(said([](Gltf& g) { g["accessors"][0]["count"] = -1; }), "is a corrupt glTF file: \"count\" is -1");
  EXPECT_EQ(said([](Gltf& g) { g["nodes"][0]["mesh"] = 1; }), "is a corrupt glTF file: it refers to 1 of its 1 meshes");
  EXPECT_EQ(said([](Gltf& g) { g["accessors"][0]["componentType"] = 5124; }), "has a glTF accessor of an unknown component type 5124");
  EXPECT_EQ(said([](Gltf& g) { g["bufferViews"][0]["byteStride"] = 4; }),
            "has a glTF buffer view whose stride is shorter than its entries: the file is corrupt");
  EXPECT_EQ(said([](Gltf& g) { g["asset"]["version"] = "1.0"; }), "is glTF of version \"1.0\", expected 2.0: convert it");
  EXPECT_EQ(said([](Gltf& g) { g["meshes"] = "none"; }), "is a corrupt glTF file: \"meshes\" is no list");
  EXPECT_EQ(refusal("g.gltf", "{\"asset\":"), "is not a glTF file (its JSON is truncated or corrupt)");
}

TEST(GltfReader, ListsInListsDeeperThanTheStackAreNoNamesAndNoNumbers) {
  VERIFIES("LASSO-GND-014~1");
  const std::string deep = std::string(80'000, '[') + std::string(80'000, ']');
  const auto said = [&](const std::string& members) { return refusal("g.gltf", '{' + members + '}'); };
  const std::string asset = "\"asset\":{\"version\":\"2.0\"},";
  EXPECT_EQ(said("\"asset\":{\"version\":" + deep + '}'), "is glTF of version \"\", expected 2.0: convert it");
  for (const std::string list : {"extensionsRequired", "extensionsUsed"}) {
    EXPECT_EQ(said(asset + '"' + list + "\":[" + deep + ']'), "is a corrupt glTF file: \"" + list + "\" holds what is no name");
  }
  EXPECT_EQ(said(asset + "\"scenes\":[{\"nodes\":[" + deep + "]}]"),
            "is a corrupt glTF file: \"nodes\" is of the wrong type, expected a number");
}

TEST(GltfReader, BoundsTheTrianglesOfASmallFileThatPlacesAMeshManyTimes) {
  VERIFIES("LASSO-GND-014~1");
  Parts parts = box_parts();
  const std::size_t corners = 3 * 400'000;
  parts.bytes.resize(96);
  parts.bytes.append(corners, '\0');
  parts.json["bufferViews"][1]["byteLength"] = corners;
  parts.json["buffers"][0]["byteLength"] = parts.bytes.size();
  parts.json["accessors"][1]["componentType"] = 5121;
  parts.json["accessors"][1]["count"] = corners;
  Gltf nodes = Gltf::array(), all = Gltf::array();
  for (int i = 0; i < 26; ++i) {
    nodes.push_back({{"mesh", 0}});
    all.push_back(i);
  }
  parts.json["nodes"] = nodes;
  parts.json["scenes"][0]["nodes"] = all;
  EXPECT_EQ(refusal("g.glb", glb(parts)), "has more than 10000000 triangles, copies counted: export fewer copies or a coarser mesh");
}

TEST(GltfReader, RefusesEveryTruncation) {
  VERIFIES("LASSO-GND-014~1");
  const Parts parts = box_parts();
  const std::string text = with_data(parts);
  const std::string binary = glb(parts);
  for (std::size_t size = 1; size < text.size(); size += 7) EXPECT_NE(refusal("g.gltf", text.substr(0, size)), "") << size;
  for (std::size_t size = 1; size < binary.size(); size += 7) EXPECT_NE(refusal("g.glb", binary.substr(0, size)), "") << size;
}

}  // namespace
}  // namespace lasso::mdat
