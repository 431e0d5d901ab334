/* setting.h: `KEY.PATH=VALUE` of the command line, put into a tree. */
#ifndef SCENARIO_SETTING_H
#define SCENARIO_SETTING_H

#include "tree.h"

/* Puts the scalar VALUE where the path leads, over what was there. A part of the path is a
 * mapping's key, made when missing, or the index from 0 of an item that the list has. False
 * after a refusal. `setting` must outlive the tree. */
bool setting_apply(struct node *root, const char *setting, struct refusal *refusal);

/* All of them in turn. */
bool settings_apply(struct node *root, const char *const *settings, size_t count,
                    struct refusal *refusal);

#endif
