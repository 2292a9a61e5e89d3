//! The window of Drypoint, in which a volume is turned and its scene file edited.
//!
//! | file | |
//! |---|---|
//! | [`document`] | the scene file: its text, changes by key, undo, saving |
//! | [`session`] | the document with its scene, its volume, its frame; what panels share |
//! | [`frames`] | the thread that draws, and follows the camera |
//! | `page.rs` | the thread that draws exact frames with points and lines |
//! | [`probe`] | the thread that tells what is seen at a pixel |
//! | `brush.rs` | the thread that tells where a brush meets the volume |
//! | [`slice`](mod@slice) | slices of the volume, a voxel a pixel |
//! | [`focus`] | halos focused at a place |
//! | [`looks`] | presets and own looks, with pictures |
//! | [`compare`] | the card against the reference, in the background |
//! | [`plane`] | counts of voxels over two quantities |
//! | `paths.rs` | relative paths of a scene that is saved in another folder |
//! | [`camera`] | moves of the camera in closed form |
//! | [`views`] | cameras that are kept by a name |
//! | [`panels`] | the panels; a further one is an entry in [`panels::all`] |
//! | [`commands`] | the list that menus, keys and the palette share |
//! | [`export`] | the reference's picture, in the background |

pub mod app;
mod background;
mod brush;
pub mod camera;
pub mod canvas;
pub mod commands;
pub mod compare;
mod dialogs;
pub mod document;
pub mod edit;
pub mod export;
pub mod focus;
mod following;
pub mod frames;
pub mod gallery;
pub mod history;
pub mod key;
pub mod looks;
mod mailbox;
pub mod open;
mod page;
mod palette;
pub mod panels;
mod paths;
pub mod picture;
pub mod plane;
mod pointer;
mod present;
pub mod probe;
pub mod schema;
pub mod screen;
pub mod session;
pub mod slice;
pub mod state;
pub mod views;
pub mod widgets;
