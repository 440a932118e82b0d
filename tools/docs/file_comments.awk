# For doxygen: the comment that a header begins with is about the file, not about what comes next in it.
/^\/\/\/ / && !begun { print "/// @file"; begun = 1 }
/^#include|^namespace|^struct|^class/ { begun = 1 }
{ print }
