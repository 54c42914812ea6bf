// Copyright (C) 2026 by the geocone authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef tests_test_h
#define tests_test_h

/**
 * A test that the program knows by its folder and file, e.g. mechanics/transfer-01.
 * The files are compiled several at once: each has a namespace of its own.
 */
class RegisteredTest
{
public:
  /** @param file __FILE__ */
  RegisteredTest(const char *file, void (*test)());

  /** Arguments are those that follow the name of the test, after the program's. */
  RegisteredTest(const char *file, void (*test)(int argc, char **argv));
};

#endif
