// A plug-in that registers a name which is taken.
#include <gnomon/wear_laws/wear_law_kind.hpp>

namespace {
const gnomon::Registration<gnomon::WearLawKind> registration({.name = "archard",
                                                              .help = "another one of this name",
                                                              .keys = {},
                                                              .make = [](const gnomon::Scene&) {
                                                                return gnomon::WearLaw();
                                                              }});
}  // namespace
