// Checks of chapter 12: errors, the front, a decision of the plan.
#include "tests/checks/check_12_plan.cuh"

using namespace ballpit;
using namespace ballpit::check;

int main(int argc, char** argv) {
    return checkMain(
        argc, argv, "12",
        {{"error.by_hand", "The error of a heap is sqrt(sum of d^2 / N) / r; 0 of no balls",
          "Squares: a deep contact counts more than many shallow ones that add up to it.",
          overlapByHand},
         {"error.units", "Two heaps like one, or one twice as large, have its error",
          "Otherwise 1000 balls are worse than 100, and a picture in millimetres worse than in "
          "metres.",
          overlapWithoutUnits},
         {"error.sign", "A drift is the change over |reference|: above 0 means gained",
          "Who gains energy explodes, who loses it falls asleep: a reader must see which.",
          driftByHand},
         {"error.sums", "Mean, rms and largest drift are those of all energies at once",
          "They are gathered as the run goes on, and nobody keeps its energies.", driftAtRandom},
         {"error.no_number", "After one NaN, mean, rms and largest are NaN for good",
          "A run that blew up must not look perfect.", driftOfNoNumber},
         {"front.one", "To beat: at least as good in both, better in one",
          "Equal points must not throw each other out, and a tie in speed is decided by the error.",
          beatsByHand},
         {"front.by_hand", "Fronts of 0, 1, 2, 3 and 8 points are those worked out by hand",
          "Ties and empty charts are where a front goes wrong first.", frontByHand},
         {"front.failed",
          "A run that failed, or whose error is NaN, is on no front and beats nobody",
          "What broke off early was fast, and its error is small or none.", failedRuns},
         {"front.sorted", "The front of many points is the one that sorting them gives",
          "All against all is slow and simple. So is the check, in another way.", frontAtRandom},
         {"front.order", "The order of the points and the units of the axes do not matter",
          "A front says who is better, not by how much.", frontInAnyOrder},
         {"plan.by_hand", "Parts: whole over limit, rounded up, from 1 to most",
          "On the threshold itself one part fewer is enough; just above it is not.", partsByHand},
         {"plan.fewest", "With these parts none is too large; with one fewer they would be",
          "Model no more than the scene needs, and no less.", fewestParts},
         {"plan.monotone", "A larger whole or a stricter limit never means fewer parts",
          "A plan that is cheaper where more is asked for is wrong somewhere.", monotoneParts},
         {"plan.stay", "Parts stay if they suffice and more than half of them is needed",
          "A scene that lies on a threshold would change its plan at every look.", partsThatStay},
         {"plan.substeps_by_hand", "n substeps leave 1/n^2 of the overlap that one leaves",
          "Half a substep falls half as long, and half as fast.", substepsByHand},
         {"chart.original", "In 666 three small steps beat the original loop in error and in work",
          "What costs more need not be better.", originalLoop}});
}
