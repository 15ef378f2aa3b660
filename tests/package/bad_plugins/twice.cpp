// A plug-in that registers a name which is taken.
#include <gnomon/laws/catalogue.hpp>

namespace {
const gnomon::Registration<gnomon::WearLawKind> registration(
    {.name = "archard",
     .help = "another one of this name",
     .keys = {},
     .make = [](const gnomon::Scene&) { return gnomon::WearLaw(); }});
}  // namespace
