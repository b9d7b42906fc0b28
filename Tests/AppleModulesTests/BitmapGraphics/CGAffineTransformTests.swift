import BitmapGraphics
import Foundation
import SceneModel
import Testing

@Suite struct CGAffineTransformTests {
  private let shift = CGAffineTransform(translationX: 3, y: -2)
  private let scale = CGAffineTransform(scaleX: 2, y: 5)

  private func isClose(_ a: CGPoint, _ b: CGPoint) -> Bool {
    hypot(a.x - b.x, a.y - b.y) < 1e-9
  }

  @Test func pointsFollowTheDocumentedFormula() {
    let t = CGAffineTransform(a: 1, b: 2, c: 3, d: 4, tx: 5, ty: 6)
    #expect(CGPoint(x: 10, y: 100).applying(t) == CGPoint(x: 315, y: 426))
    #expect(CGSize(width: 10, height: 100).applying(t) == CGSize(width: 310, height: 420))
    #expect(CGAffineTransform(1, 2, 3, 4, 5, 6) == t)
  }

  @Test func concatenationAppliesTheReceiverFirst() {
    let point = CGPoint(x: 1, y: 1)
    #expect(point.applying(shift.concatenating(scale)) == CGPoint(x: 8, y: -5))
    #expect(point.applying(scale.concatenating(shift)) == CGPoint(x: 5, y: 3))
  }

  @Test func modifiersApplyBeforeTheReceiver() {
    let point = CGPoint(x: 1, y: 1)
    #expect(point.applying(scale.translatedBy(x: 3, y: -2)) == CGPoint(x: 8, y: -5))
    #expect(point.applying(shift.scaledBy(x: 2, y: 5)) == CGPoint(x: 5, y: 3))
    #expect(isClose(point.applying(shift.rotated(by: .pi / 2)), CGPoint(x: 2, y: -1)))
  }

  @Test func rotationTurnsXTowardsY() {
    let quarter = CGAffineTransform(rotationAngle: .pi / 2)
    #expect(isClose(CGPoint(x: 1, y: 0).applying(quarter), CGPoint(x: 0, y: 1)))
    #expect(isClose(CGPoint(x: 0, y: 1).applying(quarter), CGPoint(x: -1, y: 0)))
  }

  @Test func inverseUndoesTheTransform() {
    var random = SplitMix64(seed: 1)
    func number() -> CGFloat { 10 * random.uniform() - 5 }
    for _ in 0..<50 {
      let t = CGAffineTransform(number(), number(), number(), number(), number(), number())
      let point = CGPoint(x: number(), y: number())
      let tolerance = 1e-8 / abs(t.a * t.d - t.b * t.c)
      let back = point.applying(t).applying(t.inverted())
      #expect(hypot(back.x - point.x, back.y - point.y) < tolerance)
    }
  }

  @Test func singularTransformsAreTheirInverse() {
    let flat = CGAffineTransform(a: 1, b: 2, c: 2, d: 4, tx: 1, ty: 1)
    #expect(flat.inverted() == flat && CGAffineTransform().inverted() == CGAffineTransform())
  }

  @Test func rectanglesBecomeTheirBoundingBox() {
    let box = CGRect(x: 1, y: 2, width: 3, height: 4)
    #expect(box.applying(scale) == CGRect(x: 2, y: 10, width: 6, height: 20))
    #expect(
      box.applying(CGAffineTransform(scaleX: -1, y: 1)) == CGRect(x: -4, y: 2, width: 3, height: 4))
    let turned = CGRect(x: -1, y: -1, width: 2, height: 2)
      .applying(CGAffineTransform(rotationAngle: .pi / 4))
    #expect(abs(turned.width - 8.0.squareRoot()) < 1e-12 && abs(turned.midX) < 1e-12)
    #expect(CGRect.null.applying(scale).isNull && CGRect.infinite.applying(shift).isInfinite)
  }

  @Test func identityIsRecognized() {
    #expect(CGAffineTransform.identity.isIdentity && !CGAffineTransform().isIdentity)
    #expect(shift.concatenating(shift.inverted()).isIdentity && !shift.isIdentity)
  }

  @Test func codingKeepsTheNumbers() throws {
    let data = try JSONEncoder().encode(scale)
    #expect(try JSONDecoder().decode(CGAffineTransform.self, from: data) == scale)
  }
}
