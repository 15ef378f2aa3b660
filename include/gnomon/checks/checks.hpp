// Judges the facts of a state: what a result cannot vouch for, each in one sentence with its
// figure.
#pragma once

#include <gnomon/model/examination.hpp>
#include <gnomon/model/observation.hpp>
#include <gnomon/terms/material.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Why the numbers of a start or of a result may be wrong.
std::vector<std::string> doubts(const Examination& facts);

/// Why the end of a run may be wrong that had these facts at its start.
std::vector<std::string> doubts(const Examination& start, const Examination& end);

/// That few nodes touch at the start, where a given approach presses bodies that may bend, so that
/// nothing could tell it before. Empty: they are more.
std::string doubt_about_few_nodes(const Examination& start);

/// Why elements make bodies stiffer than they are.
std::vector<std::string> doubts(const std::vector<Body>& bodies);

/// Throws InputError where the model cannot hold: bodies that would stick instead of sliding.
void require_model(const Examination& facts);

/// What the model leaves out, with its figure, in a line; empty where nothing is known of it.
std::string model_text(const Examination& facts);

/// The resultants in lines: "forces on the bodies: loads (0, -20), supports (0, 0), ...", the
/// reactions of named supports, and the torques.
std::string balance_text(const Examination& facts, int dim);

}  // namespace gnomon
