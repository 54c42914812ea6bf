// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef tests_test_h
#define tests_test_h

/** A test, registered under its folder and file, e.g. mechanics/transfer-01. Several
 *  files are compiled at once: each has a namespace of its own. */
class RegisteredTest
{
public:
  /** @param file __FILE__ */
  RegisteredTest(const char *file, void (*test)());

  /** Arguments are those after the program's and the test's name. */
  RegisteredTest(const char *file, void (*test)(int argc, char **argv));
};

#endif
