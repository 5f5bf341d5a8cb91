# The comment at the top is the file's; a section's headline is nobody's; a comment before a declaration is that declaration's, one
# behind a member is that member's.
1s|^/\* |/** @file\n * |
/^\/\* -* .* -* \*\/$/d
s|^\( *\)/\* |\1/** |
s|\([^ ].*\) /\* |\1 /**< |
