// Errors from the differences between runs on meshes of different elements.
#pragma once

#include <gnomon/budget/budget.hpp>
#include <string>
#include <vector>

namespace gnomon::budget {

/// Of errors in the size of the elements, which is mostly between 1 and 2.
inline constexpr double usual_order = 1.5;

/// Why the difference of two meshes says nothing about the elements of the contact: no more nodes
/// touch on the one that has more nodes, or a part of the contact has the same elements. Empty: it
/// does.
std::string why_not_refined(const Goals& one, const Goals& other);
/// Throws MeshUnchanged for such meshes.
void require_refined_contact(const Goals& one, const Goals& other);

/// differences() of two meshes. Fields are compared at the nodes of the coarse one, to which a fine
/// mesh is interpolated with little error; the other way round where its contact has too few nodes.
std::vector<double> mesh_differences(const Goals& coarse, const Goals& fine);

/// What the coarse mesh is wrong by, from one of elements of half the size, with the usual order.
std::vector<double> errors_of_coarser(const Goals& coarse, const Goals& fine);

/// Errors of the mesh of a run are, in the area of contact and the pressure over it, at least what
/// its own last closed nodes leave open: the difference of two meshes may be small by chance. So is
/// that of the largest pressure at least what it has at such a node alone. In
/// that of the pressure inside, which differences() leave out, they are added.
void respect_area(const Goals& goals, std::vector<double>& errors);

/// Which node wears deepest depends on the mesh and, where few phases are at one, on its place: the
/// error of the phases that a coarse mesh shows of the depth may be small by chance, and is at
/// least that of the whole profile.
void respect_profile(const std::vector<Scalar>& values, std::vector<double>& errors);

/// The error of the finer of two runs, and the order with which it falls.
struct Extrapolated {
  double error, order;
};

/// Richardson's extrapolation from elements of sizes h, 2h and 4h. `fine` and `coarse` are the
/// differences between neighbours; the second is not_known if there are only two. Where they do not
/// fall as an error of order 0.5 to 2 does, chance has a part in them (which node is the last
/// closed one), and the order is taken as the usual one: for 1 and 2 the estimate is then wrong by
/// a factor of 1.8. Orders below 1, which a contact with edges off the nodes does not have, are
/// taken as 1: of eleven estimates that this changed, in seven scenes of docs/notes/accuracy.md,
/// all came nearer to the true error and none below it. Differences that fall faster than with h^3
/// do so by chance.
Extrapolated extrapolated(double fine, double coarse);

/// That of values which may be those of an edge, where no mesh resolves a singular pressure before
/// wear has removed it. Differences of the same sign and of 1 % or more are not of chance there:
/// the order is the observed one down to 0.5, also for lower ones (as it rises when the edge is
/// resolved, a lower one would tell some four times the error), and not_known with the error below
/// 0.25, for the error may then be any multiple of the difference.
Extrapolated extrapolated_at_edge(double fine, double coarse);

/// Errors of a part from the differences() of three meshes, on elements `finer` times as fine as
/// those of the finest of them; and why some values are not known.
void extrapolate(BudgetPart& part, const std::vector<Scalar>& values,
                 const std::vector<double>& fine, const std::vector<double>& coarse,
                 double finer = 1);

/// Where a companion on larger elements has nothing of a value of the run, as where all of a coarse
/// contact sticks: differences to it say nothing. Makes these not_known, and `doubt` says so.
void forget_without_value(const Goals& companion, const std::vector<Scalar>& values,
                          std::vector<double>& differences, std::string& doubt);

/// Errors from meshes too coarse to tell them may be far too large. An error of order one or more
/// is at most the difference of the run to elements `times` as large, divided by times - 1: more
/// than three times that is taken off. `fine`, `coarse`: differences() to such a run, and to one of
/// elements twice as large again; the larger bound counts, since one difference may be small by
/// chance.
void respect_run(const std::vector<double>& fine, const std::vector<double>& coarse, double times,
                 std::vector<double>& errors);

}  // namespace gnomon::budget
