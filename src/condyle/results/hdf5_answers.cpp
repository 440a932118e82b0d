#include "condyle/results/hdf5_answers.h"

#include <memory>
#include <utility>
#include <vector>

namespace condyle {
namespace {

using Kind = Hdf5Question::Kind;
using Groups = std::vector<Hdf5Group>;

Hdf5Answer number(std::uint64_t number) {
  return {.number = number, .texts = {}, .values = {}, .shape = {}};
}

Hdf5Answer texts(std::vector<std::string> texts) {
  return {.texts = std::move(texts), .values = {}, .shape = {}};
}

Hdf5Answer answer(const Hdf5Question& of, Groups& groups) {
  const Hdf5Group& group = groups.at(of.group);
  switch (of.kind) {
    case Kind::kOpen: {
      Hdf5Group opened = group.open(of.name);
      groups.push_back(std::move(opened));
      return number(groups.size() - 1);
    }
    case Kind::kHas:
      return number(group.has(of.name) ? 1 : 0);
    case Kind::kHasAttribute:
      return number(group.has_attribute(of.attribute) ? 1 : 0);
    case Kind::kIsGroup:
      return number(group.is_group(of.name) ? 1 : 0);
    case Kind::kNames:
      return texts(group.names());
    case Kind::kKind:
      return number(static_cast<std::uint64_t>(group.kind(of.name)));
    case Kind::kNumbers: {
      Hdf5Array array = group.read(of.name);
      return {.texts = {}, .values = std::move(array.values), .shape = std::move(array.shape)};
    }
    case Kind::kTexts:
      return texts(group.read_texts(of.name));
    case Kind::kAttribute:
      return texts({group.read_attribute(of.attribute)});
    case Kind::kAttributeOf:
      return texts({group.read_attribute(of.name, of.attribute)});
    case Kind::kAttributeTexts:
      return texts(group.read_attribute_texts(of.name, of.attribute));
  }
  return {};
}

}  // namespace

Hdf5Process::Answering answers_of(Hdf5Group root) {
  const auto groups = std::make_shared<Groups>();
  groups->push_back(std::move(root));
  return [groups](const Hdf5Question& question) { return answer(question, *groups); };
}

}  // namespace condyle
