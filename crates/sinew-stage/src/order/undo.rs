//! How an order is taken back.

use super::Order;

/// How an order is taken back, as applying it says.
#[derive(Clone, Debug, PartialEq)]
pub enum Undo {
    /// By these orders, one after the other: they set what the order changed to what it was before.
    Orders(Vec<Order>),
    /// It changed nothing.
    Nothing,
    /// It cannot be taken back: a push has moved things, a joint is cut, a line was said.
    Impossible,
}
