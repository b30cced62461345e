// What a process learns from its launcher's environment, before MPI begins: ranks, and which GPU is
// whose.
#include "host/mpi/device_of_rank.hpp"
#include "host/mpi/launcher.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace hopscotch {
namespace {

class launch_environment : public testing::Test {
protected:
    void SetUp() override {
        for (const char* name : {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMI_RANK",
                                 "PMI_SIZE", "PMIX_RANK", "SLURM_STEP_NUM_TASKS"}) {
            const char* value = std::getenv(name);
            if (value != nullptr) before_.emplace_back(name, value);
            ::unsetenv(name);
        }
    }
    void TearDown() override {
        for (const char* name : set_) ::unsetenv(name);
        for (const auto& [name, value] : before_) ::setenv(name.c_str(), value.c_str(), 1);
    }
    void set(const char* name, const char* value) {
        ::setenv(name, value, 1);
        set_.push_back(name);
    }

private:
    std::vector<std::pair<std::string, std::string>> before_;
    std::vector<const char*> set_;
};

TEST_F(launch_environment, a_program_started_by_hand_has_no_launcher) {
    const launch started = this_launch();
    EXPECT_FALSE(started.has_mpi);
    EXPECT_EQ(started.size, 1);
}

TEST_F(launch_environment, a_batch_step_without_mpi_is_no_launcher) {
    set("SLURM_STEP_NUM_TASKS", "8");
    EXPECT_FALSE(this_launch().has_mpi);
}

TEST_F(launch_environment, ranks_of_mpirun_and_of_srun_with_pmix_are_counted) {
    set("OMPI_COMM_WORLD_RANK", "3");
    set("OMPI_COMM_WORLD_SIZE", "4");
    EXPECT_TRUE(this_launch().has_mpi);
    EXPECT_EQ(this_launch().rank, 3);
    EXPECT_EQ(this_launch().size, 4);
    ::unsetenv("OMPI_COMM_WORLD_RANK");
    ::unsetenv("OMPI_COMM_WORLD_SIZE");
    set("PMIX_RANK", "5");
    EXPECT_EQ(this_launch().size, 0) << "PMIx alone does not say how many there are";
    set("SLURM_STEP_NUM_TASKS", "8");
    EXPECT_EQ(this_launch().rank, 5);
    EXPECT_EQ(this_launch().size, 8);
}

TEST(device_of_rank, ranks_of_a_node_are_dealt_to_its_devices_in_turn) {
    EXPECT_EQ(device_of_rank("0,1,2", 0), "0");
    EXPECT_EQ(device_of_rank("0,1,2", 2), "2");
    EXPECT_EQ(device_of_rank("0,1,2", 4), "1") << "more ranks than devices share them";
    EXPECT_EQ(device_of_rank("4,GPU-8f3a", 1), "GPU-8f3a") << "names given by the batch system";
    EXPECT_EQ(device_of_rank("2", 3), "2") << "one device, given by the batch system";
    EXPECT_EQ(device_of_rank("", 0), "") << "a node without devices";
}

}  // namespace
}  // namespace hopscotch
