// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SMPExecution.h"

#include "vtkNew.h"
#include "vtkSMPTools.h"
#include "vtkTSplineFit.h"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace trivariate;

TEST(SMPExecution, CoversTheRangeOnceAndLeavesTheBackEndAlone)
{
  const std::string before = vtkSMPTools::GetBackend();
  for (const Index n : { Index(0), Index(1), Index(7), Index(100000) })
  {
    std::vector<int> visits(n, 0);
    SMPParallelFor(n,
      [&visits](Index begin, Index end)
      {
        for (Index i = begin; i < end; ++i)
        {
          ++visits[i];
        }
      });
    EXPECT_EQ(visits, std::vector<int>(n, 1));
  }
  EXPECT_EQ(vtkSMPTools::GetBackend(), before);
}

TEST(SMPExecution, UsesThreadsAndObeysTheirLimit)
{
  const auto threadsUsed = []()
  {
    std::mutex mutex;
    std::set<std::thread::id> ids;
    SMPParallelFor(1000,
      [&mutex, &ids](Index, Index)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        const std::lock_guard<std::mutex> lock(mutex);
        ids.insert(std::this_thread::get_id());
      });
    return ids.size();
  };
  if (std::thread::hardware_concurrency() > 1)
  {
    EXPECT_GT(threadsUsed(), 1u);
  }
  vtkSMPTools::Initialize(1);
  EXPECT_EQ(threadsUsed(), 1u);
  vtkSMPTools::Initialize(0);
}

TEST(SMPExecution, ThrowsWhatABodyThrows)
{
  const std::string before = vtkSMPTools::GetBackend();
  EXPECT_THROW(SMPParallelFor(100, [](Index, Index) { throw std::runtime_error("a fault"); }),
    std::runtime_error);
  EXPECT_EQ(vtkSMPTools::GetBackend(), before);
}

TEST(SMPExecution, ReportsProgressAndStopsOnAbort)
{
  vtkNew<vtkTSplineFit> filter;
  const Execution execution = SMPExecution(filter, 0.2, 0.6);
  execution.Check(0.5);
  EXPECT_DOUBLE_EQ(filter->GetProgress(), 0.4);
  filter->AbortExecuteOn();
  EXPECT_THROW(execution.Check(0.6), Aborted);
}
