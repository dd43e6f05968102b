#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/text.h"
#include "core/vec3.h"
#include "made_archive.h"
#include "reading.h"

using namespace asdfvk;
using test::ArchivedFile;
using test::holds;

namespace {

using Objects = std::vector<NamedFaces>;

const std::string kCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
const std::string kProduction = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
const std::string kVertices =
    "<vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>"
    "<vertex x='0' y='0' z='1'/></vertices>";
const std::string kTriangles =
    "<triangle v1='0' v2='2' v3='1'/><triangle v1='0' v2='1' v3='3'/><triangle v1='1' v2='2' v3='3'/>"
    "<triangle v1='2' v2='0' v3='3'/>";
const std::string kMesh = "<mesh>" + kVertices + "<triangles>" + kTriangles + "</triangles></mesh>";
const std::string kItem = "<item objectid='1'/>";

std::string object(int id, const std::string& content, const std::string& more = "") {
  return "<object id='" + std::to_string(id) + "' " + more + ">" + content + "</object>";
}

std::string model(const std::string& resources, const std::string& build = kItem, const std::string& attributes = "") {
  return "<model xmlns='" + kCore + "' " + attributes + "><resources>" + resources + "</resources><build>" + build +
         "</build></model>";
}

std::string archiveOf(const std::string& text, std::vector<ArchivedFile> others = {}, const std::string& part = "m") {
  others.push_back({.name = "_rels/.rels",
                    .contents = "<Relationships><Relationship Target='/" + part +
                                "' Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/>"
                                "</Relationships>"});
  others.push_back({.name = "m", .contents = text, .isDeflated = true});
  return test::madeArchive(others);
}

Mesh read(const std::string& text, const std::vector<ArchivedFile>& others = {}) {
  return test::parse("3mf", archiveOf(text, others));
}
std::string errorIn(const std::string& text, const std::vector<ArchivedFile>& others = {}) {
  return test::errorOf("3mf", archiveOf(text, others));
}
std::string skippedIn(const Mesh& mesh) { return joined(mesh.skipped, "; "); }

double signedVolume(const Mesh& mesh) {
  double volume = 0;
  for (const Face& f : mesh.faces)
    volume += dot(mesh.vertices[f[0]], cross(mesh.vertices[f[1]], mesh.vertices[f[2]])) / 6;
  return volume;
}

/// Object 1 is an assembly of the objects 2, 3, ... Each is a tetrahedron.
std::string assembly(int count, const std::string& type = "") {
  std::string objects, components;
  for (int i = 2; i < count + 2; ++i) {
    objects += object(i, kMesh, type);
    components += "<component objectid='" + std::to_string(i) + "'/>";
  }
  return model(objects + object(1, "<components>" + components + "</components>"));
}

ArchivedFile bambuSettings(const std::string& parts) {
  return {.name = "Metadata/model_settings.config",
          .contents = "<config><object id='1'><metadata key='name' value='x'/>" + parts +
                      "</object><plate><metadata key='plater_id' value='1'/></plate></config>"};
}

/// A mesh of three tetrahedra, each with vertices and triangles of its own, as PrusaSlicer writes volumes.
std::string threeVolumes() {
  std::string vertices, triangles;
  for (int volume = 0; volume < 3; ++volume) {
    for (const char* const p : {"0 0 0", "1 0 0", "0 1 0", "0 0 1"})
      vertices += std::string("<vertex x='") + std::to_string(p[0] - '0' + 10 * volume) + "' y='" + p[2] + "' z='" +
                  p[4] + "'/>";
    for (const Face& f : {Face{0, 2, 1}, Face{0, 1, 3}, Face{1, 2, 3}, Face{2, 0, 3}}) {
      triangles += "<triangle";
      for (uint32_t c = 0; c < 3; ++c)
        triangles +=
            " v" + std::to_string(c + 1) + "='" + std::to_string(f[c] + 4 * static_cast<uint32_t>(volume)) + "'";
      triangles += "/>";
    }
  }
  return "<vertices>" + vertices + "</vertices><triangles>" + triangles + "</triangles>";
}

ArchivedFile prusaSettings(const std::string& volumes, int id = 1) {
  return {.name = "Metadata/Slic3r_PE_model.config",
          .contents = "<?xml version='1.0'?><config><object id='" + std::to_string(id) +
                      "' instances_count='1'><metadata type='object' key='name' value='x'/>" + volumes +
                      "</object></config>"};
}

std::string volume(int first, int last, const std::string& key, const std::string& value) {
  return "<volume firstid='" + std::to_string(first) + "' lastid='" + std::to_string(last) +
         "'><metadata type='volume' key='name' value='x'/><metadata type='volume' key='" + key + "' value='" + value +
         "'/><mesh edges_fixed='0'/></volume>";
}

}  // namespace

TEST_CASE("3MF: namespaces may be bound anywhere") {
  const std::string last = "<triangle v1='2' v2='0' v3='3'/>";
  std::string bound = model(object(1, kMesh));
  bound.replace(bound.find(last), 9, "<c:triangle xmlns:c='" + kCore + "'");
  CHECK(read(bound).faceCount() == 4);
  const std::string item = "<c:item xmlns:c='" + kCore + "' objectid='1' transform='1 0 0 0 1 0 0 0 1 9 0 0'/>";
  CHECK(read(model(object(1, kMesh), kItem + item)).faceCount() == 8);
  const Mesh foreignItem = read(model(object(1, kMesh), kItem + "<item xmlns='http://vendor' objectid='1'/>"));
  CHECK(foreignItem.faceCount() == 4);
  CHECK(skippedIn(foreignItem) == "1 unknown element ('item')");
  const std::string foreign = "<triangles xmlns='http://vendor'><triangle v1='0' v2='1' v3='2'/></triangles>";
  const Mesh mesh =
      read(model(object(1, "<mesh>" + kVertices + "<triangles>" + kTriangles + "</triangles>" + foreign + "</mesh>")));
  CHECK(mesh.faceCount() == 4);
  CHECK(skippedIn(mesh) == "1 unknown element ('triangles')");
}

TEST_CASE("3MF: the path of the production extension is followed for items and components, wherever it is bound") {
  const std::vector<ArchivedFile> part{
      {.name = "3D/part.model", .contents = model(object(4, kMesh), "", "unit='centimeter'")}};
  const std::string path = " objectid='4' xmlns:q='" + kProduction + "' q:path='/3D/part.model'/>";
  for (const std::string& text :
       {model("", "<item" + path), model(object(1, "<components><component" + path + "</components>")),
        model("", "<item objectid='4' q:path='/3D/part.model'/>", "xmlns:q='" + kProduction + "'")}) {
    const Mesh mesh = read(text, part);
    CHECK(mesh.faceCount() == 4);
    CHECK(signedVolume(mesh) == doctest::Approx(1000 / 6.0));
  }
}

TEST_CASE("3MF: blanks, references, the schema 2013/01 and encoded part names are read") {
  std::string text = model(object(1, kMesh), "<item objectid=' 1&#10;' transform='2\n0\t0 0 2 0 0 0 2  10 20\r\n30 '/>",
                           "unit=' inch '");
  text.replace(text.find("x='1'"), 5, "x=' &#49; '");
  text.replace(text.find("v3='3'"), 6, "v3='&#x33;\t'");
  const Mesh mesh = read(text);
  CHECK(mesh.unit == "in");
  CHECK(mesh.vertices[1] == Vec3d{12, 20, 30});
  CHECK(signedVolume(mesh) == doctest::Approx(8 / 6.0));

  std::string old = model(object(1, kMesh));
  old.replace(old.find(kCore), kCore.size(), "http://schemas.microsoft.com/3dmanufacturing/2013/01");
  CHECK(read(old).faceCount() == 4);

  const std::string archive =
      archiveOf("", {{.name = "My Model.model", .contents = model(object(1, kMesh))}}, "My%20Model.model");
  CHECK(test::parse("3mf", archive).faceCount() == 4);
}

TEST_CASE("3MF: damage inside of the core specification is refused") {
  const auto withTriangles = [](const std::string& triangles) {
    return errorIn(model(object(1, "<mesh>" + kVertices + "<triangles>" + triangles + "</triangles></mesh>")));
  };
  CHECK(holds(withTriangles(kTriangles + "x" + kTriangles), "text 'x' between elements"));
  CHECK(holds(withTriangles(kTriangles + "x"), "text 'x' between elements"));
  CHECK(holds(withTriangles("<tria:gle v1='0' v2='1' v3='2'/>"), "unbound prefix"));
  CHECK(holds(withTriangles("<tr1angle v1='0' v2='1' v3='2'/>"), "unexpected element 'tr1angle'"));
  CHECK(holds(withTriangles("<triangle v1='0' v2='1' v3='2'><triangle/></triangle>"), "unexpected element 'triangle'"));
  CHECK(holds(errorIn(model(object(1, "<mash/>"))), "unexpected element 'mash'"));
  CHECK(holds(errorIn(model(object(1, kMesh), "<itom objectid='1'/>")), "unexpected element 'itom'"));
  CHECK(holds(errorIn(model(object(1, kMesh, "type='modal'"))), "'modal' is not a type of object"));
  CHECK(
      holds(errorIn(model(object(2, kMesh) + object(1, kMesh + "<components><component objectid='2'/></components>"))),
            "object 1 has a mesh and components"));
  CHECK(skippedIn(read(model(object(1, kMesh) + "<objact id='2'/>"))) == "1 unknown element ('objact')");
}

TEST_CASE("3MF: elements of extensions that may have geometry are told, others are not") {
  const std::string resources =
      object(1, kMesh + "<v:shape xmlns:v='http://vendor'/>") +
      "<m:colorgroup xmlns:m='http://schemas.microsoft.com/3dmanufacturing/material/2015/02' id='9'/>"
      "<s:slicestack xmlns:s='http://schemas.microsoft.com/3dmanufacturing/slice/2015/07' id='8'/>";
  CHECK(skippedIn(read(model(resources))) == "2 unknown elements ('shape', 'slicestack')");
}

TEST_CASE("3MF: build items that are not to be printed are left out and told") {
  const std::string items =
      kItem +
      "<item objectid='1' printable='0'/><item objectid='1' printable='false'/><item objectid='1' printable='1'/>";
  const Mesh mesh = read(model(object(1, kMesh), items));
  CHECK(mesh.faceCount() == 8);
  CHECK(skippedIn(mesh) == "2 build items that are not to be printed");
  CHECK(errorIn(model(object(1, kMesh), "<item objectid='1' printable='0'/>")) ==
        "has 1 build item that is not to be printed and no triangle: nothing to compute on");
}

TEST_CASE("3MF: objects that are not material by the core specification are left out and told") {
  const std::string items = kItem + "<item objectid='2'/>";
  for (const auto& [type, phrase] :
       {std::pair{"support", "1 support"}, std::pair{"solidsupport", "1 support"},
        std::pair{"surface", "1 surface without volume"}, std::pair{"other", "1 object of type other"}}) {
    const std::string shown = type;  // Clang 14 captures no structured binding.
    CAPTURE(shown);
    const Mesh mesh = read(model(object(1, kMesh) + object(2, kMesh, std::string("type='") + type + "'"), items));
    CHECK(mesh.faceCount() == 4);
    CHECK(skippedIn(mesh) == phrase);
    // The type of an object with components is ignored: the types of the components count.
    const std::string group =
        object(2, "<components><component objectid='1'/></components>", std::string("type='") + type + "'");
    CHECK(read(model(object(1, kMesh) + group, items)).faceCount() == 8);
  }
}

TEST_CASE("3MF: parts of Bambu Studio and OrcaSlicer that are not material are left out and told") {
  const std::string parts =
      "<part id='2' subtype='normal_part'><metadata key='matrix' value='1 0 0 0'/></part>"
      "<part id='3' subtype='negative_part'/><part id='4' subtype='modifier_part'/>"
      "<part id='5' subtype='support_blocker'/><part id='6' subtype='support_enforcer'/>"
      "<part id='7' subtype='a_new_part'/><part id='8'/>";
  for (const char* const type : {"", "type='model'"}) {
    const Mesh mesh = read(assembly(7, type), {bambuSettings(parts)});
    CHECK(mesh.faceCount() == 8);
    CHECK(mesh.negativeVolumeCount == 2);  // The part of an unknown type may be one.
    CHECK(skippedIn(mesh) ==
          "1 negative volume; 1 modifier; 1 support blocker; 1 support enforcer; 1 part of an unknown type");
  }
  // Bambu Studio may state the type "other" for such parts.
  CHECK(read(assembly(2, "type='model'"), {bambuSettings("<part id='3' subtype='negative_part'/>")})
            .negativeVolumeCount == 1);
  const std::string other =
      model(object(2, kMesh) + object(3, kMesh, "type='other'") +
            object(1, "<components><component objectid='2'/><component objectid='3'/></components>"));
  const Mesh negativeOther = read(other, {bambuSettings("<part id='3' subtype='negative_part'/>")});
  CHECK(negativeOther.negativeVolumeCount == 1);
  CHECK(skippedIn(negativeOther) == "1 negative volume");
}

TEST_CASE("3MF: parts in other files, parts that are one object, and an object that is its own part") {
  const std::string path = " xmlns:q='" + kProduction + "' q:path='/o'/>";
  const std::string inOther = model(
      object(1, "<components><component objectid='5'" + path + "<component objectid='6'" + path + "</components>"));
  const ArchivedFile objects{.name = "o", .contents = model(object(5, kMesh) + object(6, kMesh), "")};
  const Mesh other = read(
      inOther, {objects, bambuSettings("<part id='5' subtype='normal_part'/><part id='6' subtype='negative_part'/>")});
  CHECK(other.faceCount() == 4);
  CHECK(other.negativeVolumeCount == 1);

  const std::string twice =
      model(object(2, kMesh) + object(1,
                                      "<components><component objectid='2'/><component objectid='2' transform='1 0 0 0 "
                                      "1 0 0 0 1 5 0 0'/></components>"));
  const Mesh same =
      read(twice, {bambuSettings("<part id='2' subtype='modifier_part'/><part id='2' subtype='normal_part'/>")});
  CHECK(same.faceCount() == 4);
  CHECK(same.vertices[0] == Vec3d{5, 0, 0});
  CHECK(skippedIn(same) == "1 modifier");

  CHECK(errorIn(model(object(1, kMesh)), {bambuSettings("<part id='1' subtype='negative_part'/>")}) ==
        "has 1 negative volume and no triangle: nothing to compute on");
}

TEST_CASE("3MF: volumes of PrusaSlicer that are not material are left out and told") {
  const std::string text = model(object(1, "<mesh>" + threeVolumes() + "</mesh>"));
  for (const auto& [type, phrase, negativeCount] :
       {std::tuple{"NegativeVolume", "1 negative volume", 1u}, std::tuple{"ParameterModifier", "1 modifier", 0u},
        std::tuple{"SupportBlocker", "1 support blocker", 0u}, std::tuple{"SupportEnforcer", "1 support enforcer", 0u},
        std::tuple{"SeamPosition", "1 part of an unknown type", 1u}}) {
    const std::string shown = type;  // Clang 14 captures no structured binding.
    CAPTURE(shown);
    const Mesh mesh =
        read(text, {prusaSettings(volume(0, 3, "volume_type", "ModelPart") + volume(4, 7, "volume_type", type) +
                                  volume(8, 11, "volume_type", "ModelPart"))});
    CHECK(skippedIn(mesh) == phrase);
    CHECK(mesh.negativeVolumeCount == negativeCount);
    CHECK(mesh.faceCount() == 8);
    CHECK(mesh.vertices.size() == 8);  // No vertex of the volume is left.
    CHECK(mesh.vertices[4] == Vec3d{20, 0, 0});
    CHECK(signedVolume(mesh) == doctest::Approx(2 / 6.0));
  }
  const Mesh older = read(text, {prusaSettings(volume(0, 3, "modifier", "1") + volume(4, 11, "modifier", "0"))});
  CHECK(older.faceCount() == 8);
  CHECK(skippedIn(older) == "1 modifier");
  // PrusaSlicer does not bind the prefix of its texts.
  const std::string written =
      "<volume firstid='0' lastid='3'><metadata type='volume' key='volume_type' "
      "value='NegativeVolume'/><slic3rpe:text text='a' style_name='b'/></volume>";
  CHECK(read(text, {prusaSettings(written)}).negativeVolumeCount == 1);
  const std::string both =
      "<volume firstid='4' lastid='7'><metadata type='volume' key='modifier' value='1'/>"
      "<metadata type='volume' key='volume_type' value='ModelPart'/></volume>";
  CHECK(skippedIn(read(text, {prusaSettings(both)})).empty());
  CHECK(skippedIn(read(text, {prusaSettings(volume(0, 11, "volume_type", "ModelPart"))})).empty());
}

TEST_CASE("3MF: settings that do not fit to the model are refused") {
  const std::string text = model(object(1, "<mesh>" + threeVolumes() + "</mesh>"));
  const std::string negative = "NegativeVolume", name = "Metadata/Slic3r_PE_model.config: triangles ";
  CHECK(errorIn(text, {prusaSettings(volume(8, 12, "volume_type", negative))}) ==
        name + "8 to 12: the object has 12 triangles");
  CHECK(errorIn(text, {prusaSettings(volume(8, 7, "volume_type", negative))}) ==
        name + "8 to 7: the object has 12 triangles");
  CHECK(errorIn(text,
                {prusaSettings(volume(0, 4, "volume_type", "ModelPart") + volume(4, 7, "volume_type", negative))}) ==
        name + "4 to 7: overlap another range");
  CHECK(errorIn(text, {prusaSettings(volume(0, 3, "volume_type", negative), 2)}) ==
        name + "0 to 3: the model has no object 2");
  CHECK(read(text, {prusaSettings(volume(0, 3, "volume_type", "ModelPart"), 2)}).faceCount() == 12);
  CHECK(holds(errorIn(text, {bambuSettings("<part id='3' subtype='negative_part'/>")}),
              "Metadata/model_settings.config: part 3 is not a part of object 1"));
  CHECK(holds(errorIn(text, {bambuSettings("<part subtype='negative_part'/>")}), "a part has no id and no triangles"));
  CHECK(holds(errorIn(text, {{.name = "Metadata/model_settings.config", .contents = "<config><object"}}), "truncated"));
}

TEST_CASE("3MF: modifiers of Slic3r and of Cura are left out and told") {
  const std::string volumes =
      "<s:volumes xmlns:s='http://schemas.slic3r.org/3mf/2017/06'><s:volume ts='0' te='3' modifier='0'/>"
      "<s:volume ts='4' te='7' modifier='1'><s:metadata type='slic3r.x'>1</s:metadata></s:volume></s:volumes>";
  const Mesh slic3r = read(model(object(1, "<mesh>" + threeVolumes() + volumes + "</mesh>")));
  CHECK(slic3r.faceCount() == 8);
  CHECK(skippedIn(slic3r) == "1 modifier");

  const auto cura = [](const std::string& key, const std::string& value) {
    return read(
        model(object(1, kMesh) + object(2, "<metadatagroup><metadata name='cura:" + key + "' type='xs:string'>" +
                                               value + "</metadata></metadatagroup>" + kMesh),
              kItem + "<item objectid='2'/>"));
  };
  CHECK(skippedIn(cura("infill_mesh", "True")) == "1 modifier");
  CHECK(skippedIn(cura("cutting_mesh", "True")) == "1 modifier");
  CHECK(skippedIn(cura("anti_overhang_mesh", "True")) == "1 support blocker");
  CHECK(skippedIn(cura("support_mesh", "True")) == "1 support");
  CHECK(cura("support_mesh", "True").faceCount() == 4);
  CHECK(cura("support_mesh", "False").faceCount() == 8);
  CHECK(cura("support_mesh_drop_down", "True").faceCount() == 8);
}

TEST_CASE("3MF: faces have the name of their object, or else of the object that it is a component of") {
  const std::string components = "<components><component objectid='1'/><component objectid='2'/></components>";
  const std::string items =
      "<item objectid='1'/><item objectid='2'/><item objectid='5'/><item objectid='3'/>"
      "<item objectid='4'/><item objectid='6'/>";
  const Mesh mesh =
      read(model(object(1, kMesh) + object(2, kMesh, "name=' left&#10;arm '") + object(3, components, "name='both'") +
                     object(4, components) + object(5, "<mesh><vertices/><triangles/></mesh>", "name='empty'") +
                     object(6, kMesh, "name='support' type='support'"),
                 items));
  CHECK(mesh.faceCount() == 24);
  CHECK(mesh.objects == Objects{{4, "left arm"}, {8, "both"}, {12, "left arm"}, {16, ""}, {20, "left arm"}});
}

TEST_CASE("3MF: faces have the names that slicers give to parts and objects") {
  const std::string named = "<metadata key='name' value='left arm'/></part>";
  const std::string parts = "<part id='2' subtype='normal_part'>" + named + "<part id='3' subtype='normal_part'/>" +
                            "<part id='4' subtype='negative_part'><metadata key='name' value='hole'/></part>";
  CHECK(read(assembly(3), {bambuSettings(parts)}).objects == Objects{{0, "left arm"}, {4, "x"}});
  // The names of the parts are more specific than those of their objects.
  CHECK(read(assembly(2, "name='object'"), {bambuSettings(parts.substr(0, parts.find("<part id='4'")))}).objects ==
        Objects{{0, "left arm"}, {4, "object"}});
  CHECK(read(model(object(1, kMesh)), {bambuSettings("<part id='1'>" + named)}).objects == Objects{{0, "left arm"}});

  const std::string text = model(object(1, "<mesh>" + threeVolumes() + "</mesh>"));
  const auto withName = [](int first, int last, const std::string& name, const std::string& type) {
    return volume(first, last, "volume_type", type + "'/><metadata type='volume' key='name' value='" + name);
  };
  const std::string last = withName(8, 11, "right", "ModelPart");
  CHECK(read(text, {prusaSettings(withName(0, 3, "left", "ModelPart") + withName(4, 7, "", "ModelPart") + last)})
            .objects == Objects{{0, "left"}, {4, "x"}, {8, "right"}});
  CHECK(
      read(text, {prusaSettings(withName(0, 3, "left", "ModelPart") + withName(4, 7, "m", "ParameterModifier") + last)})
          .objects == Objects{{0, "left"}, {4, "right"}});
  CHECK(read(text, {prusaSettings(last + withName(0, 3, "hole", "NegativeVolume"))}).objects ==
        Objects{{0, "x"}, {4, "right"}});
  // Ranges that do not fit the mesh name nothing.
  CHECK(read(text, {prusaSettings(withName(0, 3, "left", "ModelPart") + withName(2, 7, "overlap", "ModelPart") +
                                  withName(9, 12, "beyond", "ModelPart"))})
            .objects == Objects{{0, "left"}, {4, "x"}});
}

TEST_CASE("3MF: a small file that unfolds meets the limit of faces before its faces are made") {
  std::string objects = object(1, kMesh);
  for (int i = 2; i <= 17; ++i) {
    const std::string use = "<component objectid='" + std::to_string(i - 1) + "'/>";
    objects += object(i, "<components>" + use + use + "</components>");
  }
  const std::string text = model(objects, "<item objectid='17'/>");
  const std::string bytes = archiveOf(text);
  CHECK(bytes.size() < 2000);
  CHECK(holds(test::errorOf("3mf", bytes), "has 262,144 faces"));
  const MeshSource allowed{.bytes = std::span(bytes.data(), bytes.size()), .options = {.maxFaces = 262'144}};
  CHECK(formatOfExtension("3mf")->parseMesh(allowed).faceCount() == 262'144);
  const MeshSource less{.bytes = allowed.bytes, .options = {.maxFaces = 262'143}};
  CHECK_THROWS_AS(formatOfExtension("3mf")->parseMesh(less), Error);
}

TEST_CASE("3MF: several names of one part are read once, and the bytes of all parts are limited") {
  std::string items;
  for (const char* const path : {"/3D/a%20b.model", "/3d/A b.model", "3D/A%20B.MODEL"})
    items += "<item objectid='1' xmlns:q='" + kProduction + "' q:path='" + path + "'/>";
  CHECK(read(model("", items), {{.name = "3D/a b.model", .contents = model(object(1, kMesh), "")}}).faceCount() == 12);
  CHECK(holds(errorIn(model(object(1, kMesh)), {{.name = "M", .contents = "x"}}), "2 files have the name"));

  const ArchivedFile blanks{.name = "big", .contents = std::string(90 << 20, ' '), .isDeflated = true};
  std::vector<ArchivedFile> parts;
  std::string uses;
  for (int i = 0; i < 3; ++i) {
    parts.push_back(blanks);
    parts.back().name += std::to_string(i);
    parts.back().contents += model(object(1, kMesh), "");
    uses += "<item objectid='1' xmlns:q='" + kProduction + "' q:path='/big" + std::to_string(i) + "'/>";
  }
  CHECK(errorIn(model("", uses), parts) == "its files have more than 256 MiB");
}

TEST_CASE("3MF: a decimal comma and an undefined number are named") {
  const auto withX = [](const std::string& x) {
    return model(object(1, "<mesh><vertices><vertex x='" + x + "' y='0' z='0'/></vertices><triangles/></mesh>"));
  };
  CHECK(holds(errorIn(withX("0,5")), "x '0,5' is not a number: numbers have a decimal comma; write them with a point"));
  CHECK(holds(errorIn(withX("1.#QNAN")), "the program that wrote the file had an undefined value"));
}
