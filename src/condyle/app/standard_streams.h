#pragma once

/// What a command says. Where a standard stream does not take it the work goes on, and the program
/// says so when the work is done: words are never the reason why a result is lost.

namespace condyle {

/// At the start of a program: a stream that the caller closed (>&-) is taken, so that no file gets its
/// number and what is said goes into none; a reader that goes away (| head) or a file beyond the
/// process's limit is an error of the call that meets it and not the end of the program.
void prepare_standard_streams();

/// At its end. Throws InputError where the standard output did not take all; a reader that has gone
/// away wanted no more.
void finish_standard_output();

}  // namespace condyle
