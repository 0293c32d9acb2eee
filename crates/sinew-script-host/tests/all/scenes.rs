//! Every shipped scene with a controller runs, gives the bits of golden.json, and replays to them.

use crate::golden::scenes;

scenes! {
    true:
    dunk "dunk"
    glider "glider"
    reach_grasp "reach_grasp"
    stapler "stapler"
}
