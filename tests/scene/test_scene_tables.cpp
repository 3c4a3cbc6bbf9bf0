// The tables of the scene format: the reader asks for each of their keys and for no other, and the JSON
// Schema that is made from them refuses what the reader refuses.
#include <stdexcept>

#include "catch2.hpp"
#include "format/scene_value.hpp"
#include "scene_folder.hpp"
#include "schema_faults.hpp"

namespace causticl {
namespace {

/// Scenes for both to judge.
struct Cases {
  Json scenes = Json::array();
  std::vector<std::string> messages;  // of the reader; empty: it loads
  std::vector<std::string> pointers;  // to the fault

  void add(const SceneFolder& folder, const Json& scene, const std::string& pointer = "") {
    scenes.push_back(scene);
    messages.push_back(user_error_of([&] { folder.load(scene.dump()); }));
    pointers.push_back(pointer);
  }
};

/// The example of a table, ready for a value of `key`: without the keys that exclude it.
Json room_for(const SceneTable& table, const SceneKey& key) {
  Json object = parse_scene(table_examples().at(table.name).object);
  const std::string name = key.name;
  for (const KeyRule& rule : table.rules) {
    if (rule.relation == KeyRule::Relation::needs) continue;
    if (name == rule.first) object.erase(rule.second);
    if (name == rule.second) object.erase(rule.first);
  }
  object.erase(name);
  return object;
}

}  // namespace

TEST_CASE("every table has an example, which loads and which the schema accepts") {
  const SceneFolder folder;
  Cases cases;
  for (const auto& [name, table] : all_tables()) {
    INFO(name);
    REQUIRE(table_examples().count(name) == 1);
    const auto& [pointer, object] = table_examples().at(name);
    cases.add(folder, scene_with(pointer, parse_scene(object)));
  }
  CHECK(all_tables().size() == table_examples().size());
  const auto verdicts = schema_verdicts(cases.scenes);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    INFO(cases.scenes[i]);
    CHECK(verdicts[i] == "ok");
    CHECK(cases.messages[i].empty());
  }
}

TEST_CASE("the reader and the schema refuse every fault of every key") {
  const SceneFolder folder;
  Cases cases;
  for (const auto& [table_name, table] : all_tables()) {
    const auto& [pointer, text] = table_examples().at(table_name);
    const auto add = [&, place = pointer](const Json& object, const std::string& key) {
      cases.add(folder, scene_with(place, object), place + "/" + key);
    };
    Json object = parse_scene(text);
    object["no_such_key"] = 1;
    add(object, "no_such_key");
    object.erase("no_such_key");
    if (!table->type.empty()) {
      object["type"] = "no such type";
      add(object, "type");
      object.erase("type");
      cases.add(folder, scene_with(pointer, object), pointer);  // a texture without it is read as a colour
    }
    for (const SceneKey& key : table->keys) {
      const Json room = room_for(*table, key);
      if (std::holds_alternative<Absent::Required>(key.absent.value)) add(room, key.name);
      for (const char* name : {key.name, key.alias})
        for (const Json& fault : name ? faults_of(key.type) : std::vector<Json>()) {
          object = room;
          object[name] = fault;
          add(object, name);
        }
      if (!key.alias) continue;
      object = room;
      object[key.name] = object[key.alias] = good_value(key.type);
      add(object, key.alias);
    }
    for (const KeyRule& rule : table->rules) {
      object = parse_scene(text);
      object[rule.first] = good_value(table->row(rule.first).type);
      object[rule.second] = good_value(table->row(rule.second).type);
      if (rule.relation == KeyRule::Relation::needs) object.erase(rule.second);
      cases.add(folder, scene_with(pointer, object), pointer);
      object.erase(rule.first);
      object.erase(rule.second);
      if (rule.relation == KeyRule::Relation::one_of) cases.add(folder, scene_with(pointer, object), pointer);
    }
  }
  // Null is a fault of every key: a key that the reader never asked for would load with it.
  const auto verdicts = schema_verdicts(cases.scenes);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    INFO(cases.scenes[i] << "\n" << cases.messages[i]);
    CHECK(verdicts[i] != "ok");
    CHECK(cases.messages[i].find(": " + cases.pointers[i]) != std::string::npos);
  }
  CHECK(verdicts.size() > 1000);
}

TEST_CASE("the reader and the schema accept both ends of every range") {
  const SceneFolder folder;
  Cases cases;
  std::vector<std::string> expected;
  for (const auto& [table_name, table] : all_tables())
    for (const SceneKey& key : table->keys) {
      const bool integer = key.type.kind == ValueType::Kind::integer;
      if ((!integer && key.type.kind != ValueType::Kind::number) || key.type.range.exclusive) continue;
      for (const double end : {key.type.range.low, key.type.range.high}) {
        Json object = room_for(*table, key);
        object[key.name] = end;
        cases.add(folder, scene_with(table_examples().at(table_name).pointer, object));
        expected.push_back(integer ? "expected an integer" : key.type.range.expected);
      }
    }
  const auto verdicts = schema_verdicts(cases.scenes);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    INFO(cases.scenes[i]);
    CHECK(verdicts[i] == "ok");
    // Several values together may still be too much: a picture of 2^28 x 480 pixels.
    CHECK(cases.messages[i].find(expected[i]) == std::string::npos);
  }
  CHECK(verdicts.size() > 50);
}

TEST_CASE("what no table declares cannot be read") {
  const JsonDocument document = json_parse("t", R"({"absorption": 1, "shine": 2})");
  static const SceneTable table{
      "t",
      "",
      "test",
      {{"absorption", types::number(), required, "a number"}, {"shine", types::number(), 0, ""}}};
  const SceneObject object(JsonReader(document), table);
  CHECK(object.number("absorption") == 1);
  CHECK(!object.knows("gloss"));
  CHECK_THROWS_AS(object.number("gloss"), std::logic_error);
  CHECK_THROWS_AS(object.find("gloss"), std::logic_error);
  CHECK_THROWS_AS(object.has("gloss"), std::logic_error);
  // Nor is it read as another type.
  CHECK_THROWS_AS(object.boolean("shine"), std::logic_error);
  CHECK_THROWS_AS(object.at("shine").items(), std::logic_error);
}

}  // namespace causticl
