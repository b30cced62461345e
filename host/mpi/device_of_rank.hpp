// One GPU per rank: the ranks of a node are dealt to its devices before any of them is opened.
#pragma once

#include <string>
#include <string_view>

namespace hopscotch {

/// The one device that the rank sees.
///
/// \param visible  devices the node's ranks may use, as CUDA_VISIBLE_DEVICES lists them
/// \return         one entry of the list: ranks beyond the last device begin again at the first;
///                 empty where there are no devices
std::string device_of_rank(std::string_view visible, int rank_in_node);

/// Narrows CUDA_VISIBLE_DEVICES to this rank's device. A batch system that has given the rank one
/// device already is left alone, and so is a node without devices.
void choose_device(int rank_in_node);

}  // namespace hopscotch
